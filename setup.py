"""The source distribution keeps the links of the repository, which setuptools alone would copy."""

import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.sdist import sdist


class WithLinks(sdist):
    """`sdist`, but for the folders of the package that are links to others of the same archive."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        super().make_release_tree(base_dir, files)
        for link in filter(Path.is_symlink, Path("chapsym").rglob("*")):
            copy = Path(base_dir, link)
            shutil.rmtree(copy)
            copy.symlink_to(link.readlink())


setup(cmdclass={"sdist": WithLinks})
