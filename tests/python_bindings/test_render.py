# SPDX-License-Identifier: MPL-2.0
"""The picture of a run: there, full of cells in their colours, the same every time."""
import shutil

import numpy
import pytest
import synthetic_run

from npfem import __main__ as program
from npfem.render import cell_colours, render
from npfem.run_output import read_run
from npfem.section_plot import cell_outlines, velocity_in_section

matplotlib_image = pytest.importorskip("matplotlib.image")


def colours_of(path):
    """Share of the picture's pixels that are blood red, and yellow."""
    red, green, blue = matplotlib_image.imread(str(path))[..., :3].transpose(2, 0, 1)
    is_red = (red > 0.3) & (green < 0.4 * red) & (blue < 0.4 * red)
    is_yellow = (red > 0.5) & (green > 0.55 * red) & (blue < 0.55 * red)
    return is_red.mean(), is_yellow.mean()


@pytest.fixture(scope="module")
def tube_picture(tube_run, tmp_path_factory):
    """The picture of the made-up tube, drawn by the verb."""
    path = tmp_path_factory.mktemp("picture") / "preview.png"
    assert program.main(["preview", tube_run, "-o", str(path)]) == 0
    return path


def test_tube(tube_picture):
    red, yellow = colours_of(tube_picture)
    assert 0.03 < red < 0.6
    assert 0.002 < yellow < 0.2
    assert matplotlib_image.imread(str(tube_picture)).std() > 0.1
    assert [path.name for path in tube_picture.parent.iterdir()] == ["preview.png"]


def test_platelets_alone_bring_no_red(tmp_path):
    run = synthetic_run.write_run(str(tmp_path), size=(12.0, 12.0, 12.0), counts=(0, 6))
    render(run, str(tmp_path / "picture.png"))
    red, yellow = colours_of(tmp_path / "picture.png")
    assert yellow > 0.005
    assert red < 0.001


@pytest.mark.parametrize("kind, size, counts", [("shear_box", (16.0, 12.0, 12.0), (3, 2)),
                                                ("plates", (40.0, 10.0, 8.0), (3, 0))])
def test_other_vessels(kind, size, counts, tmp_path):
    render(synthetic_run.write_run(str(tmp_path), kind, size, counts=counts), str(tmp_path / "picture.png"))
    assert colours_of(tmp_path / "picture.png")[0] > 0.01


def test_a_vessel_without_cells(tube_run, tmp_path):
    run = shutil.copytree(tube_run, tmp_path / "run")
    (run / "cells.pvd").unlink()
    render(str(run), str(tmp_path / "picture.png"))
    assert colours_of(tmp_path / "picture.png") == (0, 0)


def test_one_run_gives_one_picture(tube_run, tube_picture, tmp_path):
    render(tube_run, str(tmp_path / "again.png"))
    assert (tmp_path / "again.png").read_bytes() == tube_picture.read_bytes()


def test_a_cell_keeps_its_colour(tube_run):
    snapshot = read_run(tube_run)
    colours = cell_colours(snapshot, numpy.arange(len(snapshot.triangles)))
    for cell in numpy.unique(snapshot.cell_id):
        assert len(numpy.unique(colours[snapshot.cell_id == cell], axis=0)) == 1
    assert len(numpy.unique(colours, axis=0)) == len(numpy.unique(snapshot.cell_id))


def test_velocity_in_the_section(tube_run):
    plane = velocity_in_section(read_run(tube_run))
    assert plane.shape == (24, 32)
    heights = (numpy.arange(24) + 0.5) * 0.5 - 6
    # Poiseuille flow, 30 mm/s on the axis; the plane lies between the nodes at +-0.25 um.
    numpy.testing.assert_allclose(plane[:, 5], 30 * numpy.clip(1 - (heights ** 2 + 0.0625) / 36, 0, None), rtol=1e-5)


def test_cells_that_stick_out_come_back_at_the_other_end(tube_run):
    snapshot = read_run(tube_run)
    cell = snapshot.cell_id[0]
    vertices = numpy.unique(snapshot.triangles[snapshot.cell_id == cell])
    # Its middle on the end face and on the plane of the section.
    target = numpy.array([6.0, 6.0, 16.0])
    snapshot.points[vertices] += target - snapshot.points[vertices].mean(axis=0)
    outlines = cell_outlines(snapshot, cell)
    ends = [(outline[:, 0].min(), outline[:, 0].max()) for outline in outlines]
    assert any(low < 16 < high for low, high in ends)
    assert any(low < 0 < high for low, high in ends)


@pytest.mark.parametrize("arguments, words", [(["/nowhere"], "/nowhere"), (["RUN", "--instant", "9"], "number 9"),
                                              (["RUN", "-o", "/nowhere/a.png"], "/nowhere/a.png")])
def test_bad_input(arguments, words, tube_run, capsys):
    assert program.main(["preview"] + [tube_run if word == "RUN" else word for word in arguments]) == 2
    assert words in capsys.readouterr().err
