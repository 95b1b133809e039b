#!/usr/bin/env python3
"""Edge cracks in a rail as a plate of the thickness of head, web and foot, in tension: K_I/(sigma
sqrt(pi a)) by plane finite elements and the difference of energies. Prints rail_fe.csv; needs numpy
and scipy."""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as la

NU, E = 0.3, 210e3


def grade(points, finest, ratio, coarsest):
    """Lines through `points`, graded away from each (point, is_fine)."""
    lines = [points[0][0]]
    for (a, fa), (b, fb) in zip(points[:-1], points[1:]):
        def half(length, fine):
            h, out, x = (finest if fine else coarsest), [], 0.0
            while x + h < length:
                x += h
                out.append(x)
                h = min(h * ratio, coarsest)
            return out
        left = half((b - a) / 2, fa)
        right = half((b - a) / 2, fb)
        inside = [a + x for x in left] + [b - x for x in reversed(right)]
        lines += inside + [b]
    return np.array(lines)


def energy(a, layers, loads, finest, foundation=0.0, half_length=6000.0):
    """Compliance energies (loads x loads) of the half rail cracked to depth a: tractions of the
    crack faces are the loads."""
    H = sum(h for h, _ in layers)
    tops = np.cumsum([0] + [h for h, _ in layers])
    ys = grade([(0, False), (a, True)] + [(t, False) for t in tops[1:]], finest, 1.25, 4.0)
    xs = grade([(0, True), (60, False), (half_length, False)], finest, 1.25, 40.0)
    nx, ny = len(xs) - 1, len(ys) - 1
    gx = np.empty(2 * nx + 1); gx[::2] = xs; gx[1::2] = (xs[1:] + xs[:-1]) / 2
    gy = np.empty(2 * ny + 1); gy[::2] = ys; gy[1::2] = (ys[1:] + ys[:-1]) / 2
    mx, my = len(gx), len(gy)
    C = E / (1 + NU) / (1 - 2 * NU) * np.array([[1 - NU, NU, 0], [NU, 1 - NU, 0], [0, 0, (1 - 2 * NU) / 2]])
    g3, w3 = np.polynomial.legendre.leggauss(3)
    sh = lambda t: (np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - .5, -2 * t, t + .5]))
    # An element is hy/hx of one matrix, hx/hy of another, and a third.
    parts = [np.zeros((18, 18)) for _ in range(3)]
    for p, wp in zip(g3, w3):
        for q, wq in zip(g3, w3):
            (n, dn), (m, dm) = sh(p), sh(q)
            X, Y = np.zeros((3, 18)), np.zeros((3, 18))
            dx, dy = np.outer(dn, m).ravel(), np.outer(n, dm).ravel()
            X[0, ::2] = dx; X[2, 1::2] = dx; Y[1, 1::2] = dy; Y[2, ::2] = dy
            parts[0] += wp * wq * X.T @ C @ X
            parts[1] += wp * wq * Y.T @ C @ Y
            parts[2] += wp * wq * (X.T @ C @ Y + Y.T @ C @ X)
    i, j = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
    hx, hy = np.diff(xs)[i], np.diff(ys)[j]
    middles = (ys[1:] + ys[:-1]) / 2
    b = np.array([layers[np.searchsorted(tops, y) - 1][1] for y in middles])[j] / layers[0][1]
    K = sum((b * f)[..., None, None] * part for f, part in zip((hy / hx, hx / hy, np.ones_like(hx)), parts))
    nodes = np.stack([(2 * i + s) * my + 2 * j + t for s in range(3) for t in range(3)], -1)
    dof = np.stack([2 * nodes, 2 * nodes + 1], -1).reshape(nx, ny, 18)
    rows = [np.repeat(dof, 18, axis=-1).ravel()]
    cols = [np.tile(dof, (1, 1, 18)).ravel()]
    vals = [K.ravel()]
    N = 2 * mx * my
    K = sp.coo_matrix((np.concatenate(vals), (np.concatenate(rows), np.concatenate(cols))), (N, N)).tolil()
    if foundation:
        for i in range(nx):
            hx = xs[i + 1] - xs[i]
            M = hx / 30 * np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]])
            d = [2 * ((2 * i + s) * my + my - 1) + 1 for s in range(3)]
            for s in range(3):
                for t in range(3):
                    K[d[s], d[t]] += foundation / layers[0][1] * M[s, t]
    ja = int(np.argmin(abs(gy - a)))
    fixed = [2 * j for j in range(ja, my)]
    if not foundation:
        fixed.append(1 + 2 * (my - 1))
    free = np.setdiff1d(np.arange(N), fixed)
    F = np.zeros((N, len(loads)))
    for j in range(ja // 2):
        hy = ys[j + 1] - ys[j]
        for p, w in zip(g3, w3):
            n, _ = sh(p)
            y = (ys[j] + ys[j + 1]) / 2 + p * hy / 2
            for l, load in enumerate(loads):
                for t in range(3):
                    F[2 * (2 * j + t), l] += w * hy / 2 * n[t] * load(y)
    U = la.splu(K.tocsc()[free][:, free]).solve(F[free])
    return F[free].T @ U


def sif(a, layers, load, foundation=0.0, finest=0.08):
    """K_I: half of the body, G per width of the head, E' G = K^2; the whole body stores twice the energy."""
    d = 0.02 * a
    up, down = (energy(a + s * d, layers, [load], finest, foundation)[0, 0] for s in (1, -1))
    # energy W = F u / 2 of half a body with faces loaded; G = dW/da of the whole = d(F u)/da
    G = (up - down) / (2 * d)
    return np.sqrt(G * E / (1 - NU ** 2))


RAIL = [(36.46563744, 72.0), (119.20059067, 21.76506262), (16.33377189, 150.0)]  # 60E1

if __name__ == "__main__":
    print("# K_I/(sigma sqrt(pi a)) of an edge crack in the head of a 60E1 under tension sigma, by rail_fe.py.")
    print("depth_mm,foundation_mpa,tension")
    for foundation in (0.0, 50.0):
        for a in (10.0, 20.0, 30.0):
            print(f"{a:g},{foundation:g},{sif(a, RAIL, lambda y: 1.0, foundation) / np.sqrt(np.pi * a):.4f}", flush=True)
