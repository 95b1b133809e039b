"""A straight inclined crack by GetFEM: parts of problem 03, or problem 02.

    python3 crack.py [PART [STEP [FIRST [PASSAGES]]]]    writes 03.csv or 02.csv, to be scored

Needs GetFEM with its Python module (Debian: python3-getfem), Gmsh (PyPI: gmsh) and numpy. STEP is that of the
contact over a (0.05), FIRST the length of the elements at tip and mouth (0.002 mm), PASSAGES their number (2).

By superposition the mesh computes only what the crack changes: its faces carry the tractions of the uncracked
half-plane, and what they transmit to each other. They touch from node to node, with Lagrange multipliers in
GetFEM's augmented Lagrangian and without a penalty.
"""

import sys
import tomllib
from pathlib import Path

import getfem as gf
import gmsh
import numpy as np

HERE = Path(__file__).resolve().parent
PROBLEMS = HERE.parents[1]
sys.path.insert(0, str(HERE.parent / "numpy"))
from edge_crack import hertz  # noqa: E402

SIZE = 600.0  # mm from the crack to the sides and to the bottom, which are free
GROWTH = 0.25  # of the length of the elements with the distance from tip and mouth
APART = 1e-6  # mm between the nodes of both faces, which GetFEM would take as one otherwise
AUGMENTATION = 0.1  # of the multipliers; with 1 Newton's method cycles
TOLERANCE = 1e-11  # of the residual, mm
ITERATIONS = 60
NEAR = (0.05, 0.8)  # mm: the jumps at these distances from the tip give K


class Crack:
    """The mesh with its crack, and the contact between its faces."""

    def __init__(self, length, angle, friction, elasticity, first):
        self.length, self.friction, self.first = length, friction, first
        self.along = np.array([np.cos(np.radians(angle)), -np.sin(np.radians(angle))])
        self.normal = np.array([-self.along[1], self.along[0]])
        self.modulus, poisson = elasticity["young_modulus_mpa"], elasticity["poisson_ratio"]
        self.plane = self.modulus / (1.0 - poisson**2)
        mesh = self.mesh()
        space = gf.MeshFem(mesh, 2)
        space.set_fem(gf.Fem("FEM_PK(2,2)"))
        rule = gf.MeshIm(mesh, gf.Integ("IM_TRIANGLE(4)"))
        self.kept = [mesh, space, rule]  # GetFEM deletes what Python forgets
        self.pairs(space)
        model = self.model = gf.Model("real")
        model.add_fem_variable("u", space)
        # Stresses are in units of Young's modulus, so that one tolerance does for forces and displacements.
        model.add_initialized_data("lame", [poisson / (1 + poisson) / (1 - 2 * poisson)])
        model.add_initialized_data("shear", [0.5 / (1 + poisson)])
        model.add_isotropic_linearized_elasticity_brick(rule, "u", "lame", "shear")
        # Three displacements of the bottom: what acts is in equilibrium, so that they carry nothing.
        model.add_initialized_data("held_at", [-SIZE, -SIZE, -SIZE, -SIZE, SIZE, -SIZE])
        model.add_initialized_data("held_along", [1.0, 0.0, 0.0, 1.0, 0.0, 1.0])
        model.add_pointwise_constraints_with_multipliers("u", "held_at", "held_along")
        self.loaded = model.add_explicit_rhs("u", np.zeros(space.nbdof()))
        count = len(self.s)
        model.add_variable("pressing", count)
        model.add_initialized_data("augmentation", [AUGMENTATION])
        gap = self.jumps(self.normal, space.nbdof())
        model.add_initialized_data("no_gap", np.zeros(count))
        model.add_initialized_data("uniform", np.ones(count))
        if friction == 0.0:
            model.add_basic_contact_brick("u", "pressing", "augmentation", gap, "no_gap", "uniform", 1)
            return
        model.add_variable("sliding", count)
        model.add_initialized_data("friction", [friction])
        model.add_initialized_data("rate", [1.0])
        model.add_initialized_data("before", np.zeros(space.nbdof()))
        slip = self.jumps(self.along, space.nbdof())
        model.add_basic_contact_brick(
            "u", "pressing", "sliding", "augmentation", gap, slip, "friction", "no_gap", "uniform", 1,
            "rate", "before",
        )  # fmt: skip

    def mesh(self):
        """Triangles of Gmsh, fine at tip and mouth; the nodes of the crack are there twice, but for the tip."""
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        geo, field = gmsh.model.geo, gmsh.model.mesh.field
        tip = self.length * self.along
        corners = [(-SIZE, 0), (-SIZE, -SIZE), (SIZE, -SIZE), (SIZE, 0), (0, 0), tip]
        points = [geo.addPoint(x, y, 0) for x, y in corners]
        sides = [geo.addLine(points[k], points[(k + 1) % 5]) for k in range(5)]
        rail = geo.addPlaneSurface([geo.addCurveLoop(sides)])
        crack = geo.addLine(points[4], points[5])
        geo.synchronize()
        gmsh.model.mesh.embed(1, [crack], 2, rail)
        ends = field.add("Distance")
        field.setNumbers(ends, "PointsList", points[4:])
        size = field.add("MathEval")
        field.setString(size, "F", f"{self.first} + {GROWTH} * F{ends}")
        field.setAsBackgroundMesh(size)
        for name in ("FromPoints", "ExtendFromBoundary", "FromCurvature"):
            gmsh.option.setNumber(f"Mesh.MeshSize{name}", 0)
        gmsh.model.mesh.generate(2)
        numbers, xyz, _ = gmsh.model.mesh.getNodes()
        node = dict(zip(numbers, xyz.reshape(-1, 3)[:, :2]))
        on = set(gmsh.model.mesh.getNodes(1, crack, True)[0]) - set(gmsh.model.mesh.getNodes(0, points[5])[0])
        triangles = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
        gmsh.finalize()
        mesh, kind = gf.Mesh("empty", 2), gf.GeoTrans("GT_PK(2,1)")
        for triangle in triangles:
            xy = np.array([node[n] for n in triangle])
            side = np.sign(xy.mean(0) @ self.normal)
            xy += [0.5 * APART * side * self.normal if n in on else [0.0, 0.0] for n in triangle]
            mesh.add_convex(kind, xy.T)
        return mesh

    def pairs(self, space):
        """The nodes of both faces from the mouth to the tip: self.s along the crack, and the unknowns of each."""
        at = space.basic_dof_nodes()[:, ::2]
        s, off = self.along @ at, self.normal @ at
        on = (np.abs(off) < 2 * APART) & (s < self.length - 1e-6)
        faces = []
        for side in (1.0, -1.0):
            own = np.flatnonzero(on & (side * off > 0.1 * APART))
            faces.append(2 * own[np.argsort(s[own])])
        self.plus, self.minus = faces
        assert len(self.plus) == len(self.minus)
        self.s = s[self.plus // 2]
        tip = np.flatnonzero((np.abs(off) < 0.1 * APART) & (np.abs(s - self.length) < 1e-9))
        assert len(tip) == 1

    def jumps(self, direction, unknowns):
        """The matrix of −(u+ − u−) in a direction."""
        matrix = gf.Spmat("empty", len(self.s), unknowns)
        for k in range(len(self.s)):
            for c in (0, 1):
                matrix.add(k, self.plus[k] + c, -direction[c])
                matrix.add(k, self.minus[k] + c, direction[c])
        return matrix

    def load(self, stress):
        """Nodal forces on faces that transmit nothing: they take away the tractions of the uncracked rail."""
        nodes = np.append(self.s, self.length)
        points, weights = np.polynomial.legendre.leggauss(20)
        shape = np.stack([0.5 * points * (points - 1), 1 - points**2, 0.5 * points * (points + 1)])
        forces = np.zeros((len(nodes), 2))
        for k in range(0, len(nodes) - 2, 2):
            half = 0.5 * (nodes[k + 2] - nodes[k])
            s = nodes[k] + half * (points + 1)
            xx, yy, xy = stress(s * self.along[0], s * self.along[1])
            n = self.normal
            # The outer normal of the + side is −n, its traction in the uncracked rail −σ n.
            t = np.stack([xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]])
            forces[k : k + 3] += half * (shape * weights) @ t.T
        rhs = np.zeros(self.model.variable("u").size)
        for c in (0, 1):
            rhs[self.plus + c] = forces[:-1, c]
            rhs[self.minus + c] = -forces[:-1, c]
        return rhs

    def intensities(self):
        """K_I and K_II (MPa√m) by the jumps near the tip: jump = 8 K/E' √(r/2π) (1 + c r), fitted; K_I is zero
        where the faces touch next to the tip."""
        u = self.model.variable("u")
        jump = np.stack([u[self.plus + c] - u[self.minus + c] for c in (0, 1)])
        r = self.length - self.s
        near = (r > NEAR[0]) & (r < NEAR[1])
        scale = self.plane / 8.0 * np.sqrt(2.0 * np.pi / 1000.0)
        ki, kii = [scale * np.polyfit(r[near], (d @ jump)[near] / np.sqrt(r[near]), 1)[1] for d in (self.normal, self.along)]
        return ki if (self.normal @ jump)[r < NEAR[0]].max() > TOLERANCE else 0.0, kii

    def step(self, stress):
        """Equilibrium under the next position of the contact, with friction on what slips from the last one:
        whether Newton's method converges."""
        if self.friction > 0.0:
            self.model.set_variable("before", -self.model.variable("u"))
        self.model.set_private_rhs(self.loaded, self.load(stress) / self.modulus)
        return self.model.solve(
            "max_res", TOLERANCE, "max_iter", ITERATIONS, "lsolver", "mumps", "lsearch", "simplest"
        )[0] < ITERATIONS  # fmt: skip


def main(name="45deg-faces0.3-contact+0.3", step="0.05", first="0.002", passages="2"):
    number = "02" if name == "15deg" else "03"
    with open(next(PROBLEMS.glob(f"{number}-*")) / "problem.toml", "rb") as file:
        problem = tomllib.load(file)
    part = problem["common"] | next(p for p in problem["part"] if p["name"] == name)
    (length, angle), = part["cracks"][0]["segments_mm_deg"]
    a, p0, friction = part["half_width_mm"], part["peak_pressure_mpa"], part["contact_friction"]
    crack = Crack(length, angle, part["face_friction"], problem["elasticity"], float(first))
    start, end, _ = part["positions_over_a"]
    within = np.linspace(start, end, round((end - start) / float(step)) + 1)
    far = np.array([1000.0, 100.0, 30.0, 15.0, 10.0, 8.0, 7.0])
    failed = 0
    for _ in range(int(passages)):
        lines = [f"# problem: {number}", f"# part: {name}", "# GetFEM, see README.md", "xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m"]
        for position in np.concatenate([-far, within, far[::-1]]):
            failed += not crack.step(lambda x, y: hertz(x, y, position * a, a, p0, friction))
            if abs(position) <= end + 1e-9:
                ki, kii = crack.intensities()
                lines.append(f"{position:.4f},{ki + 0.0:.5f},{kii:.5f}")
    (HERE / f"{number}.csv").write_text("\n".join(lines) + "\n")
    print(f"{len(crack.s)} pairs of nodes, {crack.model.variable('u').size} displacements, not converged: {failed}")


if __name__ == "__main__":
    main(*sys.argv[1:])
