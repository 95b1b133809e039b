"""Stress intensity factors of cracks that branch from one point of an infinite plane; writes factors.csv.

Complex potentials of dislocations along straight arms, density F(t)/sqrt(1 - t^2) on each, Gauss-Chebyshev quadrature and
collocation (Erdogan & Gupta 1972), as Panasyuk, Savruk and Datsyshin (1977) do it for branched cracks: the Burgers vectors of all
arms sum to zero, and F vanishes at the branching point on all arms but one. Needs numpy.
"""
import numpy as np


def factors(tips, stress, n):
    """K_I, K_II over sqrt(pi mm) of each tip; `tips` complex, arms from 0; `stress` = (xx, yy, xy) far away."""
    m = len(tips)
    j = np.arange(1, n + 1)
    t = np.cos((2 * j - 1) * np.pi / (2 * n))
    w = np.pi / n
    xs = np.cos(np.arange(1, n) * np.pi / n)
    size = 2 * m * n
    matrix, right = np.zeros((size, size)), np.zeros(size)
    row = 0

    def traction(z, angle, z0, g):
        """sigma_nn + i sigma_tn, up to its sign convention, on the line at `angle` through z of a dislocation g at z0."""
        d = z - z0
        psi = np.conj(g) / d + g * np.conj(z0) / d**2
        return g / d + np.conj(g / d) + np.exp(2j * angle) * (-np.conj(z) * g / d**2 + psi)

    xx, yy, xy = stress
    for tip in tips:
        angle = np.angle(tip)
        normal = 1j * np.exp(1j * angle)
        far = complex(xx * normal.real + xy * normal.imag, xy * normal.real + yy * normal.imag) * np.conj(normal)
        for x in xs:
            for q, other in enumerate(tips):
                for c, g in enumerate([1.0, 1j]):
                    v = traction(tip * (1 + x) / 2, angle, other * (1 + t) / 2, g) * w * abs(other) / 2
                    columns = 2 * (q * n + np.arange(n)) + c
                    matrix[row, columns], matrix[row + 1, columns] = v.real, v.imag
            right[row], right[row + 1] = -far.real, far.imag
            row += 2
    for c in range(2):
        for q, other in enumerate(tips):
            matrix[row, 2 * (q * n + np.arange(n)) + c] = w * abs(other) / 2
        row += 1
    at_branching = (-1.0) ** (j + n) * np.tan((2 * j - 1) * np.pi / (4 * n)) / n
    for q in range(m - 1):
        for c in range(2):
            matrix[row, 2 * (q * n + np.arange(n)) + c] = at_branching
            row += 1
    solution = np.linalg.solve(matrix, right)
    density = solution[0::2] + 1j * solution[1::2]
    at_tip = (-1.0) ** (j + 1) / np.tan((2 * j - 1) * np.pi / (4 * n)) / n
    result = []
    for q, tip in enumerate(tips):
        f = (at_tip * density[q * n : (q + 1) * n]).sum()
        k = 2 * np.conj(f) * np.exp(1j * np.angle(tip)) * np.sqrt(abs(tip) / 4) * np.pi * np.sqrt(2)
        result.append((k.real, k.imag))
    return np.array(result)


CASES = {
    "line": [1, -1],
    "cross": [1, 1j, -1, -1j],
    "star": [1, np.exp(2j * np.pi / 3), np.exp(-2j * np.pi / 3)],
    "branch": [-1, 1, 0.5 - 1j],
}
STRESSES = {"tension_x": (1, 0, 0), "tension_y": (0, 1, 0), "shear": (0, 0, 1)}

with open("factors.csv", "w", encoding="ascii") as file:
    file.write("# K over sqrt(pi mm) MPa, arm by arm\ncase,stress,arm,tip_x_mm,tip_y_mm,ki,kii,error\n")
    for number, (case, tips) in enumerate(CASES.items()):
        for s, stress in enumerate(STRESSES.values()):
            coarse, fine = factors(tips, stress, 200), factors(tips, stress, 400)
            # The error is of first order where the branching point carries a singularity.
            limit = 2 * fine - coarse if case == "branch" else fine
            for arm, tip in enumerate(tips):
                k, error = limit[arm], abs(limit[arm] - fine[arm]).max()
                z = complex(tip)
                file.write(f"{number},{s},{arm},{z.real:.15f},{z.imag:.15f},{k[0]:.6f},{k[1]:.6f},{error:.0e}\n")
