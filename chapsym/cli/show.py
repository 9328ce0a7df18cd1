"""chapsym show: the pictures of a result, and the page on which it rolls."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .app import app
from .options import Json, argument, takes, writes
from .output import check_apart, fail, following, print_json, progress_bar, put

if TYPE_CHECKING:
    from xarray import Dataset

FORMATS = {"svg": ("svg",), "png": ("png",), "pdf": ("pdf",), "both": ("svg", "png"), "gif": (), "mp4": ()}
#: The figures that can be drawn from the table of another program.
OF_TABLES = {"spheres", "omega", "attitude", "page"}


@app.command()
def show(
    result: Annotated[Path, argument("RESULT", "A result; a scene (.toml), to run first; or another program's table.")],
    output: Annotated[Path | None, writes("FOLDER", "Where to; RESULT-figures by default.")] = None,
    form: Annotated[
        str, takes("svg|png|pdf|both|gif|mp4", "Of the figures; gif, mp4: the motion, moving pictures.", "--format")
    ] = "svg",
    ball: Annotated[str | None, takes("NAME", "Show one ball of several.")] = None,
    names: Annotated[str | None, takes("A,B", "Only these; all by default.", "--figures")] = None,
    page: Annotated[
        bool | None, typer.Option("--page/--no-page", help="The interactive page; by default if it can be made.")
    ] = None,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page, or the folder, in the browser.")] = False,
    as_json: Json = False,
) -> None:
    """Draw the figures of a result, and write the page on which the ball rolls.

    Example: chapsym show docs/first.toml -o pictures
    """
    if form not in FORMATS:
        fail(f"--format {form}: give svg, png, pdf, both, gif or mp4", 2)
    if names and not FORMATS[form]:
        fail(f"--figures {names}: figures do not move; --format {form} draws the motion, so give svg, png or pdf", 2)
    check_apart(output, result)
    # One for each result: a.csv and a.parquet are two.  A scene is known by its stem.
    folder = output or result.parent / f"{result.name.removesuffix('.toml')}-figures"
    written, missing, so_far = _pictures(result, folder, form, ball, names, page)
    if as_json:
        files = [str(path) for path in written]
        print_json({"folder": str(folder), "files": files, "missing": missing, "unfinished": so_far})
    else:
        if so_far is not None:
            put(f"{result} is unfinished: {so_far}")
        for path in written:
            put(path)
        for name, reason in missing.items():
            put(f"not drawn: {name} ({reason})")
    if open_it and written:
        import webbrowser

        chosen = next((path for path in written if path.suffix == ".html"), folder)
        webbrowser.open(chosen.resolve().as_uri())


def _pictures(
    result: Path, folder: Path, form: str, ball: str | None, names: str | None, page: bool | None
) -> tuple[list[Path], dict[str, str], str | None]:
    """Writes what was asked for; the files, why each figure that is missing is, and how much of the run there is."""
    from chapsym import files
    from chapsym.dynamics import BadInput
    from chapsym.show import figures
    from chapsym.show.drawing import reading
    from chapsym.show.rolling.page import html
    from chapsym.studies.foreign import FOREIGN

    if form == "mp4":
        from chapsym.show.moving import check_writer

        check_writer(form)
    dataset = reading.with_balls(_opened(result, folder), ball)
    reading.begun(dataset)
    reasons = figures.available(dataset) if FORMATS[form] else {}
    wanted = _named(names, list(reasons)) if names else [name for name, reason in reasons.items() if reason is None]
    missing = {} if names else {name: reason for name, reason in reasons.items() if reason is not None}
    rolling = None
    try:
        if page is not False and (page or not names):
            rolling = html(dataset)
    except BadInput as error:
        if page:
            raise
        missing["page"] = str(error)
    written = figures.save_all(dataset, folder, FORMATS[form], names=wanted)
    if not FORMATS[form]:
        from chapsym.show.moving import save_motion

        written.append(folder / f"motion.{form}")
        with progress_bar("drawing", 1000) as shown:
            save_motion(dataset, written[-1], progress=lambda drawn, of: shown(1000 * drawn // of))
    if rolling is not None:
        written.append(folder / "page.html")
        files.write_text(written[-1], rolling)
    if dataset.attrs.get("model") == FOREIGN:
        missing = {name: "the table has no columns for it" for name in missing if name in OF_TABLES}
    return written, missing, reading.unfinished(dataset)


def _named(names: str, known: list[str]) -> list[str]:
    wanted = [name.strip() for name in names.split(",") if name.strip()]
    unknown = [name for name in wanted if name not in known]
    if unknown or not wanted:
        fail(f"--figures {names}: choose of {', '.join(known)}", 2)
    return list(dict.fromkeys(wanted))


def _opened(result: Path, folder: Path) -> "Dataset":
    """The result; a scene is run in memory, once its folder is known to take pictures."""
    from chapsym import files
    from chapsym.scene import load
    from chapsym.scene.result import formats
    from chapsym.show.result import run_scene
    from chapsym.studies.foreign import result_of

    if result.suffix != ".toml":
        try:
            own = result.suffix in formats.READABLE or not result.is_file()
            return formats.load(result) if own else result_of(result)
        except formats.NotOurs:
            return result_of(result)
    scene = load(result)
    files.check_folder(folder)
    with following() as report:
        return run_scene(scene, report).dataset
