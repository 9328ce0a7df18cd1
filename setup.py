"""Compiles the loops, where there is a compiler of C; the source distribution keeps the links of the repository."""

import os
import shutil
import sys
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

#: The bits are those of the text: no product is fused with a sum.  With -O2 lanes beyond the bound take twice as long.
FLAGS = ["-std=gnu11", "-O3", "-g0", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math"]
LOOPS = Extension(
    "chapsym.dynamics.native.compiled",
    [*(f"generated/loops{part}.c" for part in ("", "_long", "_single")), "chapsym/dynamics/native/module.c"],
    include_dirs=["generated"],
    depends=["generated/loops.h"],
    define_macros=[("Py_LIMITED_API", "0x030B0000")],
    extra_compile_args=FLAGS,
    libraries=[] if sys.platform == "win32" else ["m"],
    py_limited_api=True,
    optional=True,  # without a compiler the loops run as plain Python, to the same bits
)
#: A compiler that is a wheel.
ZIG = [sys.executable, "-m", "ziglang", "cc"]


def has_compiler() -> bool:
    """Whether the machine has a compiler of C."""
    named = os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc"
    return shutil.which(named.split()[0]) is not None


class WithAnyCompiler(build_ext):
    """`build_ext` with the compiler of the system, or of the package ziglang, and the loops of both kinds at once."""

    def build_extensions(self) -> None:
        if not has_compiler() and find_spec("ziglang"):
            self.compiler.set_executables(compiler_so=[*ZIG, "-fPIC"], compiler=ZIG, linker_so=[*ZIG, "-shared"])
        compiled = self.compiler.compile

        def at_once(sources: list[str], **options: Any) -> list[str]:
            """What each source is compiled to; the loops of long steps take as long as the others."""
            with ThreadPoolExecutor() as pool:
                found = pool.map(lambda source: compiled([source], **options), sources)
                return [path for paths in found for path in paths]

        self.compiler.compile = at_once
        super().build_extensions()


class WithLinks(sdist):
    """`sdist`, but for the folders of the package that are links to others of the same archive."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        super().make_release_tree(base_dir, files)
        for link in filter(Path.is_dir, filter(Path.is_symlink, Path("chapsym").rglob("*"))):
            copy = Path(base_dir, link)
            shutil.rmtree(copy)
            copy.symlink_to(link.readlink())


#: What of the package is a link to another place of the repository; without links it is a text that names the place.
LINKS = (
    "chapsym/checker", "chapsym/generated", "chapsym/proofs", "chapsym/scene/examples",
    "chapsym/report/templates/symbols.md",
)  # fmt: skip


def is_whole(link: Path) -> bool:
    """Whether a link was made, or what it leads to was copied."""
    return link.is_dir() or (link.is_file() and not link.read_text(encoding="utf-8").startswith("../"))


if absent := [link for link in LINKS if not is_whole(Path(link))]:
    sys.exit(
        f"{absent[0]} is not what it should lead to: this source tree was unpacked, or checked out, without its "
        "symbolic links, and chapsym would be installed without its kernels; unpack the .tar.gz, or clone with "
        "git -c core.symlinks=true"
    )
is_plain = bool(os.environ.get("CHAPSYM_WITHOUT_C"))
setup(
    cmdclass={"build_ext": WithAnyCompiler, "sdist": WithLinks},
    ext_modules=[] if is_plain else [LOOPS],
    setup_requires=[] if is_plain or has_compiler() else ["ziglang>=0.13"],
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
