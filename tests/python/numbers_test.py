"""Tables of branches, sections and junctions, and labels of surfaces, from Python."""

import csv
import itertools
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy

import curveskel

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
MESHES = SOURCE / "meshes"
COLLECTION = SOURCE.parent / "shared" / "meshes"
Y = MESHES / "y.off"
TORUS = MESHES / "torus.off"

try:
    import pandas
except ImportError:
    print("numbers_test: skipped, there is no pandas")
    sys.exit(0)


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_profiles_and_junctions_are_those_of_the_program(self):
        for mesh in (Y, TORUS):
            skeleton = curveskel.extract(mesh)
            subprocess.run([PROGRAM, "extract", mesh, "-o", self.folder / "s.obj", "-q",
                            "--profiles", self.folder / "p.csv",
                            "--junctions", self.folder / "j.csv"], check=True)
            self.expect_profiles(skeleton.profiles(), self.folder / "p.csv")
            subprocess.run([PROGRAM, "extract", mesh, "-o", self.folder / "s.obj", "-q",
                            "--profiles", self.folder / "even.csv", "--spacing", "0.1"], check=True)
            self.expect_profiles(skeleton.profiles(0.1), self.folder / "even.csv")
            alone = subprocess.run([PROGRAM, "extract", mesh, "-o", self.folder / "s.obj",
                                    "--spacing", "0.1"], capture_output=True)
            self.assertEqual(alone.returncode, 2)
            self.assertIn(b"--profiles", alone.stderr)
            junctions = skeleton.junctions.reset_index()
            rows = rows_of(self.folder / "j.csv")
            self.assertEqual(len(junctions), len(rows))
            for (_, found), row in zip(junctions.iterrows(), rows):
                self.assertEqual(list(found.index), list(row))
                self.assertEqual([str(branch) for branch in found["branches"]],
                                 row["branches"].split())
                self.assertEqual(found["angles"], [float(text) for text in row["angles"].split()])

    def expect_profiles(self, profiles, path):
        rows = rows_of(path)
        self.assertEqual(list(profiles.columns), list(rows[0]))
        self.assertEqual(len(profiles), len(rows))
        for (_, found), row in zip(profiles.iterrows(), rows):
            for name, text in row.items():
                if text == "":
                    self.assertTrue(math.isnan(found[name]), name)
                else:
                    self.assertEqual(float(found[name]), float(text), name)

    def test_a_profile_is_as_dense_as_asked(self):
        skeleton = curveskel.extract(Y)
        spacing = skeleton.branches.length.max() / 50
        profiles = skeleton.profiles(spacing)
        for _, branch in profiles.groupby("branch"):
            steps = numpy.diff(branch.s)
            self.assertLessEqual(steps.max(), spacing * 1.000001)
            numpy.testing.assert_allclose(steps, steps[0])
        tangents = profiles[["tangent_x", "tangent_y", "tangent_z"]].to_numpy()
        numpy.testing.assert_allclose(numpy.linalg.norm(tangents, axis=1), 1)
        clear = profiles[~profiles.near_junction]
        self.assertTrue((clear.area >= 0.99 * math.pi * clear.inscribed_radius ** 2).all())

    def test_the_angles_of_a_y_are_those_of_its_directions(self):
        junctions = curveskel.extract(Y).junctions
        self.assertEqual(len(junctions), 1)
        junction = junctions.iloc[0]
        self.assertEqual(len(junction.angles), len(list(itertools.combinations(junction.branches, 2))))
        self.assertGreater(junction.planarity, 0.95)
        self.assertAlmostEqual(sum(junction.angles), 360, delta=5)

    def test_parts_add_up_and_labels_are_by_what_was_given(self):
        skeleton = curveskel.extract(Y)
        vertices, faces = skeleton.mesh
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
        volume = numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6
        table = skeleton.branches
        self.assertAlmostEqual(table.area.sum(), area, delta=1e-9 * area)
        self.assertAlmostEqual(table.volume.sum(), volume, delta=1e-9 * volume)
        labels = skeleton.vertex_labels()
        self.assertEqual(len(labels), len(skeleton.mesh_map))
        self.assertEqual(sorted(set(labels.tolist())), table.index.tolist())
        self.assertEqual(len(skeleton.face_labels()), len(faces))
        for branch, nodes in enumerate(skeleton.branch_nodes):
            inner = numpy.isin(skeleton.mesh_map, nodes[1:-1])
            self.assertTrue((labels[inner] == branch).all())

    def test_a_labelled_surface_is_the_surface_given(self):
        skeleton = curveskel.extract(Y)
        labels = skeleton.vertex_labels()
        plain = curveskel.extract(Y).mesh
        for extension in ("ply", "vtp", "glb"):
            path = self.folder / f"y.{extension}"
            skeleton.save_labelled(path)
            by_program = self.folder / f"program.{extension}"
            # A name that says so is enough.
            named = self.folder / f"named.labelled.{extension}"
            subprocess.run([PROGRAM, "extract", Y, "-o", self.folder / "s.obj", "-o", named, "-q",
                            "--labelled", by_program], check=True)
            self.assertEqual(path.read_bytes(), by_program.read_bytes())
            self.assertEqual(path.read_bytes(), named.read_bytes())
            again = curveskel.extract(path)
            self.assertEqual(len(again.mesh_map), len(labels))
            numpy.testing.assert_allclose(again.mesh[0], plain[0], atol=1e-6)
        binary = (self.folder / "y.glb").read_bytes()
        length = struct.unpack("<I", binary[12:16])[0]
        document = json.loads(binary[20:20 + length])
        view = document["bufferViews"][
            document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["_BRANCH"]]
            ["bufferView"]]
        content = binary[28 + length + view["byteOffset"]:][:view["byteLength"]]
        numpy.testing.assert_array_equal(numpy.frombuffer(content, "<f4"), labels)
        for call in (skeleton.save_labelled, skeleton.save):
            with self.assertRaises(curveskel.UsageError):
                call(self.folder / "y.xyz")
        with self.assertRaises(curveskel.UsageError):
            skeleton.save_labelled(self.folder / "y.obj")

    def test_the_page_is_the_program_s(self):
        for options, arguments in (({}, ()), ({"preset": "paper"}, ("--preset", "paper"))):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                curveskel.extract(Y, **options).save_html(self.folder / "y.html")
            subprocess.run([PROGRAM, "extract", Y, "-o", self.folder / "s.obj", "-q", "--html",
                            self.folder / "program.html", *arguments], check=True)
            self.assertEqual((self.folder / "y.html").read_bytes(),
                             (self.folder / "program.html").read_bytes())

    def test_sections_and_levels_have_a_time_limit(self):
        skeleton = curveskel.extract(Y)
        for call in (lambda: skeleton.profiles(time_limit=1e-9),
                     lambda: skeleton.levels(3, time_limit=1e-9)):
            with self.assertRaisesRegex(curveskel.SolverError, "time limit of 1e-09 s"):
                call()
        self.assertEqual(len(skeleton.levels(3, time_limit=60)), len(skeleton.levels(3)))
        self.assertTrue(skeleton.profiles(time_limit=60).equals(skeleton.profiles()))

    def test_the_number_is_the_index(self):
        skeleton = curveskel.extract(Y)
        self.assertEqual(skeleton.branches.index.name, "branch")
        self.assertEqual(skeleton.junctions.index.name, "node")

    def test_what_needs_a_surface_says_so(self):
        curveskel.extract(Y).save(self.folder / "y.ply")
        again = curveskel.read(self.folder / "y.ply")
        for call in (again.profiles, again.vertex_labels, again.face_labels,
                     lambda: again.save_labelled(self.folder / "z.ply"),
                     lambda: again.save_html(self.folder / "z.html")):
            with self.assertRaises(curveskel.UsageError):
                call()
        self.assertTrue(again.branches.area.isna().all())
        self.assertEqual(len(again.junctions), 1)

    def test_orders_count_from_the_root_given(self):
        skeleton = curveskel.extract(Y)
        tip = int(skeleton.branches.start.iloc[0])
        table = skeleton.branch_table(root=tip)
        self.assertEqual(sorted(table.centrifugal_order), [1, 2, 2])
        self.assertEqual(sorted(table.strahler_order), [1, 1, 2])
        self.assertTrue(curveskel.extract(TORUS).branches.strahler_order.isna().all())
        for root in (len(skeleton.vertices), -1, 1.7, "1"):
            with self.assertRaisesRegex(curveskel.UsageError, "root"):
                skeleton.branch_table(root=root)
        self.assertTrue(skeleton.branch_table(root=numpy.int64(tip)).equals(table))

    def test_components_lives_and_straight_branches(self):
        rings = curveskel.extract(MESHES / "linked-rings.off").branches
        self.assertEqual(rings.component.tolist(), list(range(len(rings))))
        self.assertGreater(len(rings), 1)
        self.assertTrue(numpy.isinf(rings.life).all())  # of rings, which stay at every level
        y = curveskel.extract(Y).branches
        self.assertEqual(numpy.isinf(y.life).sum(), 2)
        self.assertEqual(set(y.component), {0})
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertTrue((straight_tube(5).branches.tortuosity >= 0).all())

    def test_an_open_tube_is_as_wide_at_its_ends_as_in_the_middle(self):
        skeleton = straight_tube(10, is_open=True)
        self.assertEqual(skeleton.certificate["tips"], 2)
        sections = skeleton.profiles(0.25)
        numpy.testing.assert_allclose(sections.inscribed_radius, 1, atol=0.01)
        numpy.testing.assert_allclose(skeleton.radii, 1, atol=0.01)
        path = self.folder / "tube.obj"
        vertices, faces = skeleton.given
        path.write_text("".join("v {!r} {!r} {!r}\n".format(*row) for row in vertices.tolist())
                        + "".join("f {} {} {} {}\n".format(*row) for row in (faces + 1).tolist()))
        subprocess.run([PROGRAM, "extract", path, "-o", self.folder / "s.obj", "--profiles",
                        self.folder / "p.csv", "--spacing", "0.25", "-q"], check=True)
        with open(self.folder / "p.csv", newline="") as file:
            rows = [float(row["inscribed_radius"]) for row in csv.DictReader(file)]
        numpy.testing.assert_array_equal(rows, sections.inscribed_radius)


def straight_tube(length, is_open=False):
    """The skeleton of a tube of radius 1 along x."""
    angles = numpy.arange(48) * 2 * numpy.pi / 48
    along = numpy.linspace(0, length, 8 * length + 1)
    places = numpy.array([[x, math.cos(a), math.sin(a)] for x in along for a in angles])
    at = numpy.arange(len(places)).reshape(len(along), 48)
    across = numpy.roll(at, -1, 1)
    faces = numpy.stack((at[:-1], across[:-1], across[1:], at[1:]), axis=-1).reshape(-1, 4)
    if is_open:
        return curveskel.extract((places, faces))
    return curveskel.extract((places, [*faces, at[0][::-1], at[-1]]))


def samples(vertices, edges, step):
    """Points along all edges, no farther apart than `step`."""
    points = []
    for a, b in vertices[numpy.asarray(edges)]:
        count = max(2, math.ceil(numpy.linalg.norm(b - a) / step) + 1)
        share = numpy.linspace(0, 1, count)[:, None]
        points.append(a * (1 - share) + b * share)
    return numpy.concatenate(points)


def distances(points, others):
    """Of each point to the nearest of the others."""
    found = numpy.empty(len(points))
    for begin in range(0, len(points), 256):
        block = points[begin:begin + 256, None, :] - others[None, :, :]
        found[begin:begin + 256] = numpy.sqrt((block ** 2).sum(axis=2).min(axis=1))
    return found


@unittest.skipUnless(COLLECTION.exists(), f"{COLLECTION} is not there")
class PublishedTruth(unittest.TestCase):
    def test_the_aorta_s_centreline(self):
        truth = json.loads((COLLECTION / "truth" / "aorta-centerline.json").read_text())
        places, radii = numpy.array(truth["points"]), numpy.array(truth["radius"])
        skeleton = curveskel.extract(COLLECTION / truth["mesh"])
        ours = samples(skeleton.vertices, skeleton.edges, 0.3)
        off = distances(places, ours) / radii
        self.assertLess(numpy.median(off), 0.05)
        self.assertLess(numpy.quantile(off, 0.9), 0.25)
        # The inscribed radius of the profile beside that of the centreline there.
        profiles = skeleton.profiles(0.5)
        at = profiles[["x", "y", "z"]].to_numpy()
        nearest = [numpy.argmin(((at - place) ** 2).sum(axis=1)) for place in places]
        ratio = profiles.inscribed_radius.to_numpy()[nearest] / radii
        self.assertAlmostEqual(numpy.median(ratio), 1, delta=0.03)
        # A vessel: sections are round where one branch is alone, and hold the inscribed disc.
        clear = profiles[~profiles.near_junction]
        self.assertLess(clear.ellipticity.median(), 0.1)
        self.assertTrue((clear.equivalent_diameter > 1.98 * clear.inscribed_radius).all())
        # One trunk divides in two.
        table = skeleton.branches
        self.assertEqual(sorted(table.strahler_order), [1, 1, 2])
        self.assertEqual(table.mean_radius.idxmax(), table.strahler_order.idxmax())

    def test_the_neuron_s_tree(self):
        truth = curveskel.read(COLLECTION / "truth" / "neuron-722817260.swc")
        skeleton = curveskel.extract(COLLECTION / "neuron-722817260-18k.ply")
        size = numpy.linalg.norm(numpy.ptp(skeleton.mesh[0], axis=0))
        ours = samples(skeleton.vertices, skeleton.edges, 200)
        theirs = samples(truth.vertices, truth.edges, 200)
        self.assertLess(numpy.quantile(distances(ours, theirs) / size, 0.99), 0.005)
        # The segmentation that the surface is of has fewer twigs than the tree.
        self.assertLess(numpy.median(distances(theirs, ours) / size), 0.002)


if __name__ == "__main__":
    unittest.main()
