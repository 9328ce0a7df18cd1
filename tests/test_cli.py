"""The command's contract, from outside: output, exit status, one sentence for an error."""

import errno
import io
import json
import logging
import os
import re
import signal
import subprocess
import sys
import threading
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from types import SimpleNamespace

import at_work
import numpy as np
import pytest
from budget import slow
from commands import TWO, answer, changed, chapsym, child, refused
from committed import committed
from first import FIRST
from waiting import GUARD, INTERRUPTIBLE, until

from chapsym import dynamics
from chapsym.cli import app, output
from chapsym.codegen import build
from chapsym.prove import Register, Verdict, records
from chapsym.workers import Processes

STEP = ["step", "--mass-tensor", "1,2,4", "--D", "3", "--momentum", "1,-1/2,3/4", "--gamma", "2/7,3/7,6/7"]


def test_step_gives_the_contracts_fields_in_digits_and_balls_as_strings():
    found = answer(*STEP)
    assert list(found) == ["q0", "q", "momentum", "gamma"]
    assert abs(found["q0"] - 0.9919717060270817) <= 2.0**-53  # the nearest float64, or the next
    assert [len(found[k]) for k in ("q", "momentum", "gamma")] == [3, 3, 3]
    found = answer(*STEP, "--digits", "50")
    assert found["q0"] == "0.99197170602708171010388503048470154201915085122739"
    ball = answer(*STEP, "--ball", "200")["q0"]
    assert re.fullmatch(r"\[0\.9919717060270817101038850304847015420191508512273869\d+ \+/- \S+\]", ball)


def test_inertia_mass_and_radius_are_other_ways_to_say_the_ball_and_a_negative_number_is_no_option():
    other = ["step", "--inertia", "6,5,3", "--mass", "12", "--radius", "1/2", *STEP[5:]]
    assert answer(*other) == answer(*STEP)
    assert answer(*STEP[:5], "--momentum", "-1,1/2,3/4", "--gamma", "2/7,3/7,-6/7")["q0"] < 1


TENSOR = "6,1/2,-0.3;1/2,5,0.2;-0.3,0.2,7/2"


def test_an_inertia_tensor_has_nine_numbers_and_the_step_is_in_its_axes():
    digits = "--digits", "40"
    assert answer("step", "--inertia", "6,0,0;0,5,0;0,0,3", *STEP[3:], *digits) == answer(*STEP, *digits)
    ball = dynamics.Ball.from_inertia([[6, 0.5, -0.3], [0.5, 5, 0.2], [-0.3, 0.2, 3.5]], D=3)
    step = dynamics.step(ball, (1, -0.5, 0.75), (2 / 7, 3 / 7, 6 / 7))
    for text in (TENSOR, TENSOR.replace(";", ",")):
        assert answer("step", "--inertia", text, *STEP[3:]) == step.write()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["nonsense"], "No such command 'nonsense'"),
        (["step"], "Missing option '--momentum'"),
        ([*STEP, "--momentum", "1,2"], "--momentum takes 3 numbers separated by commas"),
        ([*STEP, "--momentum", "1" * 99], "3/4; '1111111111111111111111111111111111111...' has 1"),
        (["scene", "new", "y" * 300 + ".toml"], "yyy.toml: File name too long"),
        ([*STEP, "--momentum", "1,2,__import__('os')"], "is not a number; write it as 1/3, -2, 0.25 or 1e-12"),
        ([*STEP, "--momentum", "1,2,1/0"], "'1/0' divides by zero"),
        ([*STEP, "--momentum", "nan,0,0"], "'nan' is not a number"),
        ([*STEP, "--momentum", "1e400,0,0"], "beyond the range of float64"),
        ([*STEP, "--momentum", "1e99999999,0,0"], "is not a number"),
        ([*STEP, "--momentum", "100,0,0"], "no rotation of this ball has this momentum"),
        ([*STEP, "--momentum", "5,-5/2,15/4"], "folds before it reaches this momentum"),
        ([*STEP, "--gamma", "0,0,1.1"], "gamma must be a unit vector"),
        ([*STEP, "--inertia", "6,5,3"], "either --mass-tensor J1,J2,J3 or --inertia"),
        ([*STEP, "--mass-tensor", "-1,2,4"], "negative moment -1"),
        ([*STEP, "--mass", "1"], "either --D, or --mass and --radius"),
        ([*STEP, "--digits", "20", "--ball", "64"], "choose one of --digits, --precision and --ball"),
        ([*STEP, "--digits", "0"], "--digits"),
        ([*STEP, "--precision", "half"], "--precision half: give single, double or double-double, or for any number"),
        (["step", "--inertia", "1,1,3", *STEP[3:]], "no body has the inertia 1,1,3"),
        (["step", "--inertia", "1,.1,0;.1,1,0;0,0,3", *STEP[3:]], "no body has the inertia (1.1, 0.9, 3)"),
        (["step", "--inertia", "6,1,0;2,5,0;0,0,3", *STEP[3:]], "a symmetric tensor, not one with I12 = 1 and I21 = 2"),
        (["step", "--inertia", "6,0,0;0,5,1;0,2,3", *STEP[3:]], "a symmetric tensor, not one with I23 = 1 and I32 = 2"),
        (["step", "--inertia", "6,5,3", "--mass", "0", "--radius", "1", *STEP[5:]], "--mass and --radius must be posi"),
        (["step", "--inertia", "6,1,0;1,5", *STEP[3:]], "3 principal moments, or the 9 components of a tensor; '6,1"),
        (["step", "--inertia", TENSOR, *STEP[3:], "--digits", "20"], "kept in principal axes only: give the principal"),
        (["branches", "--inertia", TENSOR, *STEP[3:]], "this command takes principal axes only: give its principal"),
        (["prove", "9.9"], "no proof judges the claim '9.9'"),
        (["run", "missing.toml", "-o", "x.npz"], "missing.toml cannot be read: No such file or directory"),
        (["run", FIRST], "names no output: add -o OUT.npz"),
        (["run", FIRST, "-o", "x.txt"], "the output must end in .zarr, .nc, .csv, .parquet or .npz"),
        (["run", FIRST, "-o", "/nowhere/x.npz"], "the folder /nowhere does not exist"),
        (["codegen", "--check", "--trust", "all"], "does not go with --check"),
        (["codegen", "--trust", "nonsense"], "there is no such kernel"),
        ([*STEP, "--gamma", "0,0,1e5000"], "off 1 by more than 1e300"),
        ([*STEP, "--gamma", f"0,0,1.{'0' * 49}075", "--digits", "50"], "gamma must be a unit vector to 50 digits"),
        ([*STEP, "--momentum", "1e-400,0,0"], "below the range of float64; ask for more with --digits"),
        (["run", FIRST, "-o", "x" * 300 + ".csv"], "cannot be written: File name too long"),
        (["check", "--states", "0"], "--states"),
        (["check", "--states", "99999999999999999999"], "--states"),
        (["certify", "motion", "--foo"], "No such option: --foo (see chapsym certify motion --help)"),
        (["certify", "motion", "--digits"], "'--digits' requires an argument. (see chapsym certify motion --help)"),
        (["step", "--json=1"], "Option '--json' does not take a value. (see chapsym step --help)"),
        (["show", "."], "'.' is no result"),
        (["show", FIRST, "-o", f"{FIRST}/x/y"], "first.toml is a file"),  # before the scene is run
        (["report", "-o", "x.pdf"], "the output must end in .html or .md or .tex or .json"),
        (["report", "-o", "x"], "the output must end in .html or .md or .tex or .json"),
        (["report", "-o", "nowhere/x.md"], "the folder nowhere does not exist"),
        (["report", "--register", "claims", "--open", ".", "-o", "x.html"], "claims of your own: give one of them"),
        (["check", "-o", "x.txt"], "the page must end in .md"),
        (["extremes", "-o", "x.txt"], "the page must end in .html or .md"),
        (["extremes", "-o", "/nowhere/page.html"], "the folder /nowhere does not exist"),
        (["extremes", "nonsense"], "there is no group 'nonsense'"),
        (["bench", "nonsense"], "there is no section 'nonsense'; there are goals, trajectory, batch, steps"),
        (["bench", *STEP[1:3], "--D", "3", "--momentum", "0,0,0"], "--momentum 0,0,0: a ball at rest takes no time"),
        (["bench", "long", "-o", "x.txt"], "'x.txt': a figure must end in .svg, .png, .pdf"),
        (["bench", "memory", "-o", "x.svg"], "only work-precision and long have a figure"),
        (["bench", "long", "-o", "absent/x.svg"], "the folder absent does not exist"),
        (["run", "a\x1b]0;b\x9b\n\u202e.toml", "-o", "x.npz"], r"a\x1b]0;b\x9b\n\u202e.toml cannot be read"),
        (["run", "missing.toml", "--omega", "1,2,3"], "missing.toml cannot be read: No such file"),
        (["certify", "energy-drift", "--symmetry", "-3/2,-1,1"], "the signs must be one of (1, 1, 1), (1, -1, -1)"),
        (["report", "--open", "no where", "-o", "x.html"], "chapsym study NAME -o 'no where' makes it"),
        (["certify", "manifest", "nowhere"], "there is no folder nowhere"),
        (["lab", FIRST, "--jobs", "9" * 20], "'--jobs'"),
        (["prove", "4.3", "--rocq", FIRST], "first.toml cannot be a folder of results: it is a file"),
        ([*STEP, "--precision", "x" * 9000], f"--precision {'x' * 150}...{'x' * 149}: give single"),
        (["branches", *STEP[1:], "--momentum", f"1/{'7' * 3900},0,0"], "the numbers are too long to count their"),
    ],
)
def test_wrong_input_is_one_sentence_and_status_2(arguments, sentence):
    assert sentence in refused(*arguments)


def test_help_shows_an_example_of_each_command():
    assert chapsym("--version").stdout == "chapsym 0.1.0\n"
    listing = chapsym("--help")
    assert listing.returncode == 0
    assert chapsym().stdout == listing.stdout
    for command in re.findall(r"^  (\w+)  ", listing.stdout, re.MULTILINE):
        text = chapsym(command, "-h").stdout
        assert f"Example: chapsym {command}" in text, command
        assert not re.search("<[a-z]", text), f"chapsym {command} -h shows a type of Python's"
    kinds = re.findall(r"^  ([\w-]+)  ", chapsym("certify", "-h").stdout, re.MULTILINE)
    assert " ".join(kinds) == "no-invariant-measure heteroclinic periodic-orbit energy-drift check manifest motion run"
    assert not [kind for kind in kinds if re.search("<[a-z]", chapsym("certify", kind, "-h").stdout)]


def test_a_derivation_that_cannot_be_loaded_is_one_sentence(tmp_path):
    env = changed(
        tmp_path, "import chapsym.derive.principle as principle", "def broken(): raise KeyError('R_+')",
        "principle.kinetic_factor = broken",
    )  # fmt: skip
    commands = (
        "import sys\nfrom chapsym.cli import main\n"
        "for words in (['prove'], ['codegen', '--check']):\n"
        "    sys.argv[1:] = words\n    try:\n        main()\n"
        "    except SystemExit as ended:\n        print(ended.code, file=sys.stderr)\n"
    )
    done = subprocess.run([sys.executable, "-c", commands], capture_output=True, text=True, env=env, check=True)
    lines = done.stderr.splitlines()
    said = "chapsym: the proof script paper.s4_principle cannot be loaded: KeyError"
    assert [line.startswith(said) or line for line in lines] == [True, "1"] * 2
    assert done.stdout == ""


@pytest.mark.parametrize("option", ["--check", "--trust=all"])
def test_kernels_are_not_generated_from_what_is_not_proved(monkeypatch, option):
    judged = committed()
    open_ = judged["gibbs"]._replace(verdict=Verdict.OPEN)
    monkeypatch.setitem(build.ours().__dict__, "judged", judged | {"gibbs": open_})
    before = {path.name: path.read_bytes() for path in build.folder().iterdir() if path.is_file()}
    done = chapsym("codegen", option)
    assert "gibbs_residual comes from the claim gibbs, which is not proved" in done.stderr
    assert done.returncode == 1
    assert {path.name: path.read_bytes() for path in build.folder().iterdir() if path.is_file()} == before


def test_the_kernels_of_a_checkout_are_written_from_inside_it_only(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "would be written anew: run it from there" in refused("codegen")


def test_a_claim_that_is_named_leads_to_its_parts():
    assert "4.6 has parts that are judged apart: 4.6-body, 4.6-frame, 4.6-limit" in chapsym("prove", "4.6").stderr
    assert "parts" not in chapsym("prove", "4.6-body").stderr


def test_a_title_of_a_register_can_neither_erase_a_line_nor_add_one(tmp_path, forgotten):
    hostile = r"A \x1b[2Kdifference\r\nof\x9b2K squares."
    text = Path(TWO[1]).read_text(encoding="utf-8").replace("A difference of squares.", hostile)
    (tmp_path / "mine.py").write_text(text, encoding="utf-8")
    mine = "prove", "--register", tmp_path / "mine.py", "--records", tmp_path / "mine.jsonl", "--jobs", 1
    for options in ((), ("--list",), ("--explain",), ("--json",)):
        shown = chapsym(*mine, *options).stdout
        assert all(line.isprintable() for line in shown.split("\n"))
        assert "difference" in shown


def test_output_that_cannot_be_written_is_one_sentence_and_that_nobody_reads_ends_with_141():
    """The pipe is closed before anything is written, so that no buffer takes it."""
    command = [sys.executable, "-m", "chapsym", *STEP]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    said = "chapsym: standard output cannot be written: No space left on device\n"
    assert (done.returncode, done.stderr) == (2, said)
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, "")


def test_records_of_a_register_have_a_name_whatever_is_named(monkeypatch):
    monkeypatch.setenv("CHAPSYM_RECORDS", ".")
    assert records.default_path(Register("mine.py")).name == f"-{Register('mine.py').key}.jsonl"


def test_a_screen_that_this_python_has_not_is_not_asked_for(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "none")
    assert chapsym("--version").returncode == 0
    assert os.environ["MPLBACKEND"] == "agg"


def test_a_home_that_cannot_be_written_is_not_talked_of(tmp_path):
    home = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), os.devnull)
    wanted = "show", FIRST, "--figures", "none", "-o", tmp_path / "figures"
    assert "--figures none: choose of" in refused(*wanted, run=child, env=changed(tmp_path) | home)


@pytest.mark.parametrize("seconds", ["abc", "-1", "9" * 12])
def test_a_date_that_is_none_is_one_sentence(monkeypatch, seconds):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
    assert "SOURCE_DATE_EPOCH must be a number of seconds, such as 1700000000, not '" in refused(*STEP)


@pytest.mark.parametrize("where", ["2>&-", *slow("2>/dev/full")])
def test_a_command_whose_errors_nobody_wants_does_its_work(where):
    command = ["sh", "-c", f'"$@" {where}', "sh", sys.executable, "-m", "chapsym", *STEP]
    assert subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    assert subprocess.run([*command, "--gamma", "0,0,0"], check=False).returncode == 2


@pytest.mark.parametrize(
    ("module", "error", "status", "said"),
    [
        ("chapsym.cli.lab", "KeyboardInterrupt", 130, "interrupted"),
        ("chapsym.dynamics", "MemoryError", 2, "there is not enough memory for this"),
        ("chapsym.dynamics", "ImportError('x.so: failed to map segment')", 2, "there is not enough memory for this"),
        ("chapsym.dynamics", 'RuntimeError("can\'t start new thread")', 2, app.CROWDED),
        *(
            ("chapsym.dynamics", f"OSError({one}, {os.strerror(one)!r})", 2, app.NOT_OF_OUTPUT[one])
            for one in (errno.EMFILE, errno.ENOENT)
        ),
    ],
)
def test_an_interrupt_while_the_command_starts_and_too_little_memory_are_one_sentence(
    tmp_path, module, error, status, said
):
    lines = ["import sys", "class At:", "    @staticmethod", "    def find_spec(name, *more):"]
    lines += [f"        if name == '{module}':", f"            raise {error}", "sys.meta_path.insert(0, At)"]
    done = child(*STEP, env=changed(tmp_path, *lines))
    assert (done.returncode, done.stdout, done.stderr) == (status, "", f"chapsym: {said}\n")


def test_an_interrupt_that_python_only_writes_down_is_not_lost(monkeypatch, capsys):
    seen = threading.Event()
    monkeypatch.setattr("_thread.interrupt_main", seen.set)
    app._unraisable(SimpleNamespace(exc_type=KeyboardInterrupt))
    assert seen.wait(GUARD)
    assert capsys.readouterr().err == ""


def test_a_worker_that_begins_sees_no_interrupt_and_works_where_no_more_threads_are_started():
    with Processes(1, at_work.crowded) as pool:
        assert pool.submit(os.getpid).result() != os.getpid()
        assert signal.SIGINT in pool.submit(signal.pthread_sigmask, signal.SIG_BLOCK, ()).result()


def test_too_few_threads_leave_no_process():
    with at_work.no_thread(), pytest.raises(RuntimeError):
        Processes(1)  # the thread of its calls: one that is refused later would be waited for
    with Processes(1) as pool:
        with at_work.no_thread(), pytest.raises(RuntimeError):
            pool.submit(os.getpid)
        (worker,) = pool._processes.values()
        until(lambda: worker.exitcode is not None)
    assert worker.exitcode == -signal.SIGKILL


def test_the_end_of_the_processes_waits_for_no_call_and_leaves_nothing_half_written(tmp_path):
    with Processes(1) as pool:
        for _ in range(3):
            pool.submit(at_work.written, tmp_path / "file")
        until((tmp_path / "begun").exists)
        (worker,) = pool._processes.values()
    worker.join()
    assert os.listdir(tmp_path) == ["begun"]


def test_a_worker_that_goes_on_all_the_same_is_killed(tmp_path):
    with Processes(1) as pool:
        pool.submit(at_work.goes_on, tmp_path)
        until((tmp_path / "begun").exists)
        (worker,) = pool._processes.values()
    until(lambda: worker.exitcode is not None)  # not `join`: a thread of the pool may be the one that learns it
    assert worker.exitcode == -signal.SIGALRM


@pytest.mark.parametrize("caught", [ValueError, SystemExit])
def test_a_call_that_is_ended_from_outside_has_no_result(caught):
    """As one whose process was killed: also where the call, as a proof does, catches all."""
    with Processes(1) as pool, pytest.raises(BrokenProcessPool):
        pool.submit(at_work.asked_to_end, caught).result()


def test_a_worker_that_is_asked_to_end_sends_what_it_has_begun_to_send():
    """Half a message would hold up the pool for ever."""
    with Processes(1) as pool:
        assert pool.submit(at_work.Late).result() == "whole"


#: The command, which says when the first part of its work has arrived, and waits there.
ARRIVED = f"""{INTERRUPTIBLE}
import time
from contextlib import contextmanager
from chapsym.cli import check, main, prove

@contextmanager
def bar(label, total):
    yield lambda done: (print("arrived", flush=True), time.sleep({GUARD}))

check.progress_bar = prove.progress_bar = bar
main()
"""


CHECK, PROVE = ["check", "--states", "1"], ["prove", *TWO]


@pytest.mark.parametrize(("command", "name"), [(CHECK, "INT"), *slow((CHECK, "TERM"), (PROVE, "INT"), (PROVE, "HUP"))])
def test_an_interrupt_is_told_and_ends_the_command(command, name):
    """Sent to all processes of the command, as a terminal does, or a scheduler."""
    with subprocess.Popen(
        [sys.executable, "-c", ARRIVED, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True,
    ) as running:  # fmt: skip
        assert running.stdout.readline() == "arrived\n"
        os.killpg(running.pid, getattr(signal, f"SIG{name}"))
        _, expected = running.communicate()
    assert running.returncode == 130
    assert expected.strip().splitlines()[-1] == "chapsym: interrupted"
    assert "resource_tracker" not in expected


#: A command that is killed while two processes work.
KILLED = """import os, signal
from chapsym import jobs
if __name__ == "__main__":
    with jobs.processes(2) as crew:
        crew.submit(jobs.Call(abs, (1,))).result()
        os.kill(os.getpid(), signal.SIGKILL)
"""


def test_of_a_command_that_is_killed_nothing_is_said(tmp_path):
    (tmp_path / "killed.py").write_text(KILLED)
    done = subprocess.run([sys.executable, tmp_path / "killed.py"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (-signal.SIGKILL, "")


def test_a_run_that_meets_a_fold_keeps_what_it_has(tmp_path):
    scene = tmp_path / "fold.toml"
    scene.write_text(
        "[ball]\nmass_tensor = [1, 2, 4]\nD = 3\n[start]\nmomentum = [4.32, -2.16, 3.24]\n"
        'gamma = ["2/7", "3/7", "6/7"]\n[run]\nsteps = 100\n'
    )
    done = chapsym("run", str(scene), "-o", str(tmp_path / "fold.npz"))
    assert done.returncode == 2
    assert "step 3: the small-rotation branch folds" in done.stderr
    assert "the 3 steps before it are in" in done.stderr
    with np.load(tmp_path / "fold.npz") as data:
        assert np.isfinite(data["momentum"]).all(axis=-1).tolist() == [True] * 4 + [False] * 97
        assert data["taken"] == 3


def test_a_terminal_without_greek_gets_escapes():
    done = child("scene", "schema", env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert not json.dumps(json.loads(done.stdout), ensure_ascii=False).isascii()


def test_an_unforeseen_end_of_a_file_is_no_interruption(monkeypatch):
    from chapsym.cli import app, step

    def at_its_end(*arguments):
        raise EOFError("a damaged file")

    monkeypatch.setattr(step, "rationals", at_its_end)
    monkeypatch.setattr(sys, "argv", ["chapsym", *STEP])
    monkeypatch.setattr(logging.getLogger("chapsym"), "level", logging.INFO)  # the entry point sets it
    with pytest.raises(EOFError, match="a damaged file"):
        app.main()


@pytest.mark.skipif(not sys.prefix.isascii(), reason="in that locale Python does not find what lies in such a folder")
def test_an_output_without_greek_has_the_names_of_letters_and_no_escapes(tmp_path):
    """A locale without UTF-8; what is no sign of mathematics, as in a file's name, keeps its escape."""
    plain = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    done = child("scene", "check", FIRST, env=plain)
    assert done.stdout.isascii()
    assert "\\" not in done.stdout
    assert "K = (0.073102, -0.0613469, 0.0143061) kg m2/s" in done.stdout
    assert "gamma = (0.285714" in done.stdout
    said = "⟨𝒦,γ⟩ ≤ 10⁻⁵, Ωᵀ Λ½ ∫x²dm, é"
    assert said.encode("ascii", "chapsym") == rb"<K,gamma> <= 10-5, OmegaT Lambda1/2 integral of x2dm, \xe9"


@pytest.mark.parametrize(
    ("words", "offered"), [("chapsym ju", {"judge"}), ("chapsym scene ", {"new", "check", "schema"})]
)
def test_a_shell_completes_subcommands(words, offered):
    asked = {"_CHAPSYM_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": str(words.count(" "))}
    assert set(child(env={**os.environ, **asked}).stdout.split()) == offered
    assert "--install-completion" in chapsym("--help").stdout


def test_on_a_terminal_a_line_says_how_much_is_done_and_how_long_the_rest_takes(monkeypatch):
    screen, ticks = io.StringIO(), iter([0.0, 1.0, 3.0])
    screen.isatty = lambda: True
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setattr(output, "time", SimpleNamespace(monotonic=lambda: next(ticks)))
    with output.progress_bar("proving", 4) as shown:
        for done in (1, 2, 4):
            shown(done)
    assert screen.getvalue().split("\r\033[K") == [
        "", "proving: 1 of 4", "proving: 2 of 4, about 2 s left", "proving: 4 of 4", "",
    ]  # fmt: skip


def test_in_a_log_a_line_every_half_minute_says_how_much_is_done(monkeypatch):
    log, ticks = io.StringIO(), iter([0.0, 1.0, 2.0, 30.0, 31.0, 32.0, 40.0, 41.0])
    monkeypatch.setattr(sys, "stderr", log)
    monkeypatch.setattr(output, "time", SimpleNamespace(monotonic=lambda: next(ticks)))
    with output.progress_bar("proving", 60) as shown:
        for done in (1, 30, 31):
            shown(done)
    assert log.getvalue() == "chapsym: proving: 30 of 60, about 30 s left\n"
