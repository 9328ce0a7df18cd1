/* The loops of generated/loops.c as a module of Python: `chapsym.dynamics.native.compiled`.
 *
 * Its dictionaries `double` and `single` have a function for each loop that is exported, by the loop's name.  Arguments
 * are numbers and arrays, by position, or tuples of these; arrays are passed by the buffer protocol, not copied.  While
 * a loop runs, other threads do, too.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <string.h>

#include "loops.h"

enum { MOST = 32 };

/* The size and the codes in `struct` of the elements that a loop calls r, d, i or w. */
static int fits(char element, int is_single, const Py_buffer *view) {
    char code = view->format ? view->format[0] : 'B';
    switch (element) {
    case 'r': return is_single ? code == 'f' : code == 'd';
    case 'd': return code == 'd';
    default: return (code == 'l' || code == 'q') && view->itemsize == 8;
    }
}

/* Fills an argument from an array; -1 with an exception where that has another form. */
static int take_array(PyObject *object, const char *kind, int is_single, Py_buffer *view, argument *to) {
    int axes = kind[1] - '0', writes = kind[2] == '*';
    if (PyObject_GetBuffer(object, view, PyBUF_STRIDES | PyBUF_FORMAT | (writes ? PyBUF_WRITABLE : 0))) return -1;
    int is_good = view->ndim == axes && fits(kind[0], is_single, view);
    for (int i = 0; is_good && i < axes; i++) {
        to->n[i] = view->shape[i];
        if (i == axes - 1) is_good = view->strides[i] == view->itemsize || view->shape[i] < 2;
        else if (view->strides[i] % view->itemsize) is_good = 0;
        else to->s[i] = view->strides[i] / view->itemsize;
    }
    to->p = view->buf;
    if (is_good) return 0;
    const char *of = kind[0] == 'r' && is_single ? "float32" : kind[0] == 'i' ? "int64" : "float64";
    PyErr_Format(PyExc_TypeError, "an array of %s is wanted, of %d axes, the last contiguous", of, axes);
    PyBuffer_Release(view);
    return -1;
}

static int take(PyObject *object, const char *kind, int is_single, Py_buffer *view, argument *to) {
    switch (kind[0] == 'b' || kind[1] < '1' || kind[1] > '9' ? kind[0] : 'a') {
    case 'r': to->number = PyFloat_AsDouble(object); return to->number == -1.0 && PyErr_Occurred() ? -1 : 0;
    case 'i': to->integer = PyLong_AsLongLong(object); return to->integer == -1 && PyErr_Occurred() ? -1 : 0;
    case 'b': to->integer = PyObject_IsTrue(object); return to->integer < 0 ? -1 : 0;
    default: return take_array(object, kind, is_single, view, to);
    }
}

static PyObject *given(char kind, const argument *value) {
    if (kind == 'r') return PyFloat_FromDouble(value->number);
    return kind == 'b' ? PyBool_FromLong((long)value->integer) : PyLong_FromLongLong(value->integer);
}

static PyObject *give(const char *kinds, const argument *values) {
    Py_ssize_t count = (Py_ssize_t)strlen(kinds);
    if (count == 0) Py_RETURN_NONE;
    if (count == 1) return given(kinds[0], values);
    PyObject *all = PyTuple_New(count);
    for (Py_ssize_t i = 0; all && i < count; i++) {
        PyObject *one = given(kinds[i], values + i);
        if (!one || PyTuple_SetItem(all, i, one)) Py_CLEAR(all);
    }
    return all;
}

/* Appends objects to a list, and for a tuple its items; returns the new length, which may be more than there is room. */
static Py_ssize_t flat(PyObject *const *objects, Py_ssize_t count, PyObject **list, Py_ssize_t length) {
    for (Py_ssize_t i = 0; i < count; i++)
        if (!PyTuple_Check(objects[i])) { if (length++ < MOST) list[length - 1] = objects[i]; }
        else for (Py_ssize_t j = 0; j < PyTuple_Size(objects[i]); j++) {
            PyObject *one = PyTuple_GetItem(objects[i], j);
            length = flat(&one, 1, list, length);
        }
    return length;
}

static PyObject *call(PyObject *self, PyObject *const *given_ones, Py_ssize_t count) {
    const loop_export *loop = PyCapsule_GetPointer(self, NULL);
    if (!loop) return NULL;
    PyObject *objects[MOST];
    count = flat(given_ones, count, objects, 0);
    int is_single = loop >= loops_single && loop < loops_single + loops_single_count;
    argument arguments[MOST], values[MOST];
    Py_buffer views[MOST];
    PyObject *result = NULL;
    const char *kind = loop->takes;
    int taken = 0, is_good = 1;
    for (; *kind && is_good && taken < count; taken++) {
        views[taken].obj = NULL;
        is_good = take(objects[taken], kind, is_single, views + taken, arguments + taken) == 0;
        if (!is_good) views[taken].obj = NULL;
        while (*kind && *kind++ != ' ') {}
    }
    if (is_good && (*kind || taken != count)) {
        PyErr_Format(PyExc_TypeError, "%s takes another number of arguments than %zd", loop->name, count);
        is_good = 0;
    }
    if (is_good) {
        Py_BEGIN_ALLOW_THREADS
        loop->run(arguments, values);
        Py_END_ALLOW_THREADS
        result = give(loop->gives, values);
    }
    while (taken--)
        if (views[taken].obj) PyBuffer_Release(views + taken);
    return result;
}

static PyMethodDef definition = {"loop", (PyCFunction)(void (*)(void))call, METH_FASTCALL, "A compiled loop."};

/* Adds functions to a dictionary, and returns it. */
static PyObject *table(PyObject *all, const loop_export *loops, int count) {
    for (int i = 0; all && i < count; i++) {
        PyObject *capsule = PyCapsule_New((void *)(loops + i), NULL, NULL);
        PyObject *function = capsule ? PyCFunction_NewEx(&definition, capsule, NULL) : NULL;
        Py_XDECREF(capsule);
        if (!function || PyDict_SetItemString(all, loops[i].name, function)) Py_CLEAR(all);
        Py_XDECREF(function);
    }
    return all;
}

static int add(PyObject *module, const char *name, PyObject *value) {
    int failed = !value || PyModule_AddObjectRef(module, name, value);
    Py_XDECREF(value);
    return failed;
}

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, "compiled", "The compiled loops.", -1, NULL, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit_compiled(void) {
    PyObject *made = PyModule_Create(&module);
    if (!made) return NULL;
    PyObject *all = table(PyDict_New(), loops_double, loops_double_count);
    if (add(made, "double", table(all, loops_long, loops_long_count)) ||
        add(made, "single", table(PyDict_New(), loops_single, loops_single_count)) ||
        add(made, "text", PyUnicode_FromString(loops_text)))
        Py_CLEAR(made);
    return made;
}
