"""Strain of triangular dislocations in a full space and in a half-space, computed by cutde 26.3.6 (Nikkhoo &
Walter, 2015), as reference numbers: `python3 triangles.py > triangles.csv`. Axes x, y horizontal, z up, surface
z = 0; slip in the triangle's frame is turned to x, y, z here. Strains are written tensorial, for a jump of 1."""
import numpy as np
import cutde.fullspace as FS
import cutde.halfspace as HS
import cutde.geometry as G

rng = np.random.default_rng(7)
nu = 0.3
print("nu,x1,y1,z1,x2,y2,z2,x3,y3,z3,jx,jy,jz,px,py,pz,"
      + ",".join(f"{s}_{c}" for s in ("full", "half") for c in ("xx", "yy", "zz", "yz", "xz", "xy")))
for n in range(24):
    nu = [0.3, 0.25, 0.1][n % 3]
    centre = np.array([0.0, 0.0, -1.0 - rng.uniform(0, 1.5)])
    tri = centre + rng.uniform(-0.5, 0.5, (3, 3))
    obs = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2), -rng.uniform(0.0, 3.0)])
    if n % 6 == 0:
        obs[2] = 0.0
    while np.linalg.norm(obs - centre) < 1.5:
        obs = obs + rng.uniform(0.3, 0.8, 3) * np.array([1, 1, -1.0]) * (0.0 if n % 6 == 0 else 1.0) + np.array([1.0, 0, 0])
    slip = np.array([[1.0, -0.5, 0.7]])
    # strike, dip, tensile directions of the triangle
    frame = G.compute_efcs_to_tdcs_rotations(tri[None])[0]
    jump = slip[0] @ frame
    o, t = obs[None], tri[None]
    full, half = FS.strain(o, t, slip, nu)[0], HS.strain(o, t, slip, nu)[0]
    pick = lambda e: [e[0], e[1], e[2], e[5], e[4], e[3]]
    row = [nu, *tri.ravel(), *jump, *obs, *pick(full), *pick(half)]
    print(",".join(repr(float(v)) for v in row))
