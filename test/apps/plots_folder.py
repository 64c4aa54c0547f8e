"""A folder of results for the tests of `wingbeat plot`, a solution file, and a reader of the report."""

import contextlib
import importlib.util
import io
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLOTS = ROOT / "apps" / "plots"
HAS_H5PY = importlib.util.find_spec("h5py") is not None
VOID = {"meta", "img"}  # tags that are not closed

sys.path.insert(0, str(PLOTS))
sys.dont_write_bytecode = True


def png_size(path):
    head = path.read_bytes()[:24]
    return struct.unpack(">II", head[16:24]) if head.startswith(b"\x89PNG\r\n\x1a\n") else (0, 0)


def write_solution(path, zones=1, pressure=lambda x, y: 1.0 - 0.3 * (1.0 + x) / (x**2 + y**2)):
    """Two instances of rings around a circle of radius 1/2, cut into zones, in the layout of a CGNS file."""
    import h5py
    import numpy as np

    def group(parent, name, label):
        made = parent.create_group(name)
        made.attrs["label"] = np.bytes_(label)
        return made

    def array(parent, name, values):
        group(parent, name, "DataArray_t").create_dataset(" data", data=np.asarray(values, dtype=float))

    with h5py.File(path, "w") as file:
        base = group(file, "Base", "CGNSBase_t")
        array(group(base, "BaseIterativeData", "BaseIterativeData_t"), "TimeValues", [0.0, np.pi])
        array(group(base, "RestartData", "UserDefinedData_t"), "omega", [1.0])
        ends = np.linspace(0, 24, zones + 1).astype(int)
        for number, (first, last) in enumerate(zip(ends[:-1], ends[1:]), 1):
            zone = group(base, f"block-{number}", "Zone_t")
            angle, radius = np.meshgrid(2.0 * np.pi * np.arange(first, last + 1) / 24, np.geomspace(0.5, 5.0, 9))
            x, y = radius * np.cos(angle) + 0.5, radius * np.sin(angle)
            for instance in (1, 2):
                grid = group(zone, f"GridCoordinates{instance}", "GridCoordinates_t")
                array(grid, "CoordinateX", x)
                array(grid, "CoordinateY", y + 0.1 * instance)
                flow = group(zone, f"FlowSolution{instance}", "FlowSolution_t")
                centre = [0.25 * (c[1:, 1:] + c[:-1, 1:] + c[1:, :-1] + c[:-1, :-1]) for c in (x - 0.5, y)]
                array(flow, "Pressure", pressure(*centre))
                array(flow, "Mach", 0.8 + 0.1 / (centre[0] ** 2 + centre[1] ** 2))


class Page(HTMLParser):
    """Collects what a page refers to; notes tags that do not close what is open."""

    def __init__(self, text):
        super().__init__()
        self.open, self.unbalanced, self.links, self.images, self.tags, self.text = [], [], [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.tags.add(tag)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "img":
            self.images.append(values["src"])
        elif values.get("href") or values.get("src"):
            self.links.append(values.get("href") or values.get("src"))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.unbalanced.append(tag)

    def handle_data(self, data):
        self.text.append(data)


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name) / "run"
        shutil.copytree(ROOT / "test" / "data" / "plots", self.folder)

    def tearDown(self):
        self.temporary.cleanup()

    def keep(self, *names):
        """Leaves the named files only: figures take their time."""
        for path in self.folder.iterdir():
            if path.name not in names:
                path.unlink()

    def study(self, files):
        """Makes the folder one of two runs, of 2 and 10 harmonics."""
        whole, self.folder = self.folder, Path(self.temporary.name) / "study"
        for harmonics in (10, 2):
            run = self.folder / f"harmonics-{harmonics}"
            run.mkdir(parents=True)
            for file in files:
                shutil.copy(whole / file, run)
            case = (whole / "case.toml").read_text()
            (run / "case.toml").write_text(case.replace("harmonics = 2", f"harmonics = {harmonics}"))

    def run_program(self, **environment):
        return subprocess.run([sys.executable, str(PLOTS / "plot.py"), str(self.folder)], capture_output=True,
                              text=True, check=False, env={**os.environ, **environment})

    def plot(self):
        """The same at once: without a new process, and coarse, since drawing dots is what takes the time."""
        import plot
        plot.plt.rcParams["savefig.dpi"] = 40
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            try:
                status = plot.main([str(self.folder)])
            except SystemExit as ending:
                status = ending.code
                if isinstance(status, str):
                    print(status, file=sys.stderr)
                    status = 1
        return subprocess.CompletedProcess([], status, out.getvalue(), errors.getvalue())

    def drawn(self):
        return sorted(path.stem for path in (self.folder / "plots").glob("*.png"))

    def page(self, path):
        text = path.read_text()
        page = Page(text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        return page, text
