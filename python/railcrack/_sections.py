"""The sections of a case as classes and as dictionaries: units, ranges and words are those of the
reader of case files. Written by `tools/python_sections.py`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, ClassVar, Literal, Protocol, TypedDict

import numpy as np

from ._section import Section

Number = float | np.floating[Any] | np.integer[Any]
Count = int | np.integer[Any]
Numbers = Sequence[Number] | np.ndarray[Any, np.dtype[Any]]


class PandasFrame(Protocol):
    """A pandas table in the position of a file."""

    def to_csv(self) -> str: ...


class PolarsFrame(Protocol):
    """A polars table in the position of a file."""

    def write_csv(self) -> str: ...


File = str | os.PathLike[str] | PandasFrame | PolarsFrame


@dataclass(frozen=True, repr=False, kw_only=True)
class Rail(Section):
    """The rail: linear elastic steel in plane strain below the running surface y = 0."""

    _section: ClassVar[str] = "rail"
    young_modulus_mpa: Number | None = None
    """Young's modulus of rail and wheel. In MPa; usual: 1.8e5 to 2.3e5; accepted: 1 to 1e7;
    default: 210000.0."""
    poisson_ratio: Number | None = None
    """Poisson's ratio of rail and wheel. Usual: 0.25 to 0.33; accepted: 0 to 0.499; default: 0.3."""
    width_mm: Number | None = None
    """Length of the rail along x; cracks must stay within it. By default 300; a half-plane without
    centre_mm reaches 150 mm beyond cracks that need more. In mm; usual: 20 to 1e5; accepted: 0.01
    to 1e5."""
    depth_mm: Number | None = None
    """Depth of the rail; cracks must stay above it. In mm; usual: 20 to 250; accepted: 0.01 to 1e5;
    default: 172.0."""
    centre_mm: Number | None = None
    """x of the middle of the rail; by default the middle of the crack mouths. In mm; accepted: -1e6
    to 1e6."""
    boundary: Literal["half-plane", "block"] | None = None
    """Boundary of the rail. Default: "half-plane". "half-plane": bounded by the running surface
    only; "block": a supported block of width_mm by depth_mm; finite-element engine only."""
    bottom: Literal["clamped", "rollers"] | None = None
    """Support of the bottom of a block. Default: "clamped"; only with boundary = "block".
    "clamped": no displacement; "rollers": no vertical displacement, one point held along x."""
    sides: Literal["free", "rollers", "clamped"] | None = None
    """Support of the sides of a block. Default: "free"; only with boundary = "block". "free": no
    traction; "rollers": no horizontal displacement; "clamped": no displacement."""
    section: Literal["60E1", "54E1", "49E1", "UIC60", "UIC54", "S49", "track"] | None = None
    """Section of the cracked rail, on the foundation of [track]; cracks must stay in its head. By
    default a half-plane, too stiff for cracks deeper than 5 mm. Only with boundary = "half-plane".
    "60E1": 60 kg/m; "54E1": 54 kg/m; "49E1": 49 kg/m; "UIC60": older name; "UIC54": older name;
    "S49": older name; "track": the named section of [track]."""


class RailKeys(TypedDict, total=False):
    """Keys of `rail`, those of `Rail`."""

    young_modulus_mpa: Number | None
    poisson_ratio: Number | None
    width_mm: Number | None
    depth_mm: Number | None
    centre_mm: Number | None
    boundary: Literal["half-plane", "block"] | None
    bottom: Literal["clamped", "rollers"] | None
    sides: Literal["free", "rollers", "clamped"] | None
    section: Literal["60E1", "54E1", "49E1", "UIC60", "UIC54", "S49", "track"] | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Contact(Section):
    """Wheel-rail contact; one passage is one axle."""

    _section: ClassVar[str] = "contact"
    kind: Literal["hertz", "carter", "table", "rolling"] | None = None
    """Description of the contact. Default: "hertz". "hertz": pressure p0 sqrt(1 - (x - xc)^2 / a^2)
    and a shear proportional to it: full sliding; "carter": the same pressure in partial slip, with
    a stick zone behind the leading edge; "table": pressure and shear from a table, measured or
    computed; "rolling": a Hertz ellipse in rolling contact, from normal force, creepages and spin."""
    peak_pressure_mpa: Number | None = None
    """Peak pressure p0. In MPa; usual: 50 to 4000; accepted: 0.001 to 10000; only with kind =
    "hertz" or "carter"."""
    half_width_mm: Number | None = None
    """Half-width a of the contact. In mm; usual: 0.3 to 30; accepted: 0.01 to 100; only with kind =
    "hertz" or "carter"."""
    line_load_n_per_mm: Number | None = None
    """Wheel load per unit width. In N/mm; usual: 100 to 1e5; accepted: 1e-5 to 1e7; only with kind
    = "hertz" or "carter"."""
    wheel_radius_mm: Number | None = None
    """Radius of the wheel. In mm; usual: 150 to 700; accepted: 0.01 to 1e5; only with kind =
    "hertz" or "carter" or "rolling"."""
    rail_radius_mm: Number | None = None
    """Longitudinal radius of the rail; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01;
    only with kind = "hertz" or "carter"."""
    wheel_load_kn: Number | None = None
    """Wheel load; with the radii it defines the contact ellipse. In kN; usual: 1 to 300; accepted:
    0.001 to 10000; only with kind = "hertz" or "carter"."""
    rail_head_radius_mm: Number | None = None
    """Transverse radius of the rail head; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01;
    only with kind = "hertz" or "carter" or "rolling"."""
    wheel_profile_radius_mm: Number | None = None
    """Transverse radius of the wheel profile; inf if straight, negative if concave. In mm; usual: 5
    to 1e6; accepted: from -1e6; only with kind = "hertz" or "carter" or "rolling"."""
    lateral_half_width_mm: Number | None = None
    """Lateral semi-axis b of the contact ellipse; without it the contact is a line contact, which
    the space engine refuses. In mm; usual: 0.3 to 30; accepted: 0.1 to 1000; only with kind =
    "hertz" or "carter"."""
    lateral_mm: Number | None = None
    """Lateral position of the ellipse relative to the cracks, by default 0; with rolling, y of the
    crack in the patch; with profiles, y of the crack on rail_profile, by default under the most
    loaded patch. In mm; accepted: -100 to 100; only with kind = "hertz" or "carter" or "rolling"."""
    lateral: Literal["patch", "strip"] | None = None
    """Part of the contact that loads cracks in the plane: by default the patch, in a block or with
    coupled the strip. Only with kind = "hertz" or "carter" or "rolling". "patch": averaged along
    the crack front; "strip": at lateral_mm, as a line contact."""
    profile: File | None = None
    """CSV file with the columns u_mm,p_mpa,q_mpa, u from the wheel centre along +x, linear between
    rows; or a .mat file of the program CONTACT. Only with kind = "table"."""
    scale: Number | None = None
    """Factor on pressure and shear. Accepted: 1e-6 to 1e6; default: 1.0; only with kind = "table"."""
    strip_mm: Number | None = None
    """Lateral position, in CONTACT's frame, of the strip of a .mat file. In mm; accepted: -1000 to
    1000; only with kind = "table"."""
    friction: Number | None = None
    """Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an
    upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a
    wheel braking towards +x). Usual: 0.001 to 0.8; accepted: -1 to 1."""
    torque: Literal["driven", "braked"] | None = None
    """Direction of the shear; friction then has no sign. Only with kind = "hertz". "driven": drags
    the rail backwards; "braked": drags the rail forwards."""
    lateral_friction: Number | None = None
    """Ratio of lateral shear to pressure, > 0 towards +z; by default 0. In the plane it has no
    effect at lateral_mm = 0. Usual: 0.001 to 0.8; accepted: -1 to 1; only with kind = "hertz"."""
    traction: Number | None = None
    """Traction ratio Q/(friction P), signed like the shear on the rail along +x: < 0 drives a wheel
    towards +x; 1 and -1 are full sliding. Accepted: -1 to 1; only with kind = "carter"."""
    normal_kn: Number | None = None
    """Normal force; with profiles, the sum over the patches. In kN; usual: 1 to 300; accepted:
    0.001 to 10000; only with kind = "rolling"."""
    semi_axes_mm: Numbers | None = None
    """Semi-axes [a, b] of the contact ellipse, along and across the rail. In mm; usual: 0.3 to 30;
    accepted: 0.01 to 100; only with kind = "rolling"."""
    rail_profile: File | None = None
    """CSV file with the points y_mm,z_mm of the rail head in order, z downwards; or two columns
    without a header, or a file of MiniProf (.ban) or Simpack (.prr). Only with kind = "rolling"."""
    wheel_profile: File | None = None
    """Wheel profile in the axes and formats of rail_profile (.whl, .prw); wheel_radius_mm is the
    radius at z = 0. Only with kind = "rolling"."""
    rail_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None = None
    """Axes of rail_profile, after those that a Simpack file states; by default z-down, in MiniProf
    files also z-up. Only with kind = "rolling". "z-down": y and z as those of the rail here;
    "z-up": z points upwards; "mirrored": y points to the other side; "mirrored-z-up": both."""
    wheel_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None = None
    """Axes of wheel_profile, likewise. Only with kind = "rolling". "z-down": y and z as those of
    the rail here; "z-up": z points upwards; "mirrored": y points to the other side;
    "mirrored-z-up": both."""
    profile_smoothing_mm: Number | None = None
    """Half the length of the parabolas fitted to the profiles; about 3 for measured points with
    scatter. In mm; accepted: 0.01 to 20; default: 1.0; only with kind = "rolling"."""
    shift_mm: Number | None = None
    """y of the origin of wheel_profile on rail_profile. In mm; accepted: -200 to 200; default: 0.0;
    only with kind = "rolling"."""
    yaw_deg: Number | None = None
    """Angle of attack of the wheel, > 0 towards +y. In degrees; usual: 0 to 5; accepted: -10 to 10;
    default: 0.0; only with kind = "rolling"."""
    roll_deg: Number | None = None
    """Rotation of wheel_profile about its origin; > 0 lowers +y. In degrees; usual: 0 to 5;
    accepted: -10 to 10; default: 0.0; only with kind = "rolling"."""
    creepage_x: Number | None = None
    """Longitudinal creepage, signed by creepage_sign. Usual: 0 to 0.05; accepted: -1 to 1; default:
    0.0; only with kind = "rolling"."""
    creepage_y: Number | None = None
    """Lateral creepage. Usual: 0 to 0.05; accepted: -1 to 1; default: 0.0; only with kind =
    "rolling"."""
    spin_per_mm: Number | None = None
    """Spin creepage; with creepage_sign = "contact", > 0 turns +x (travel) towards +y. In 1/mm;
    usual: 0 to 0.00666667; accepted: -1 to 1; default: 0.0; only with kind = "rolling"."""
    creepage_sign: Literal["contact", "vehicle"] | None = None
    """Sign convention of creepages and spin. Only with kind = "rolling". "contact": of the program
    CONTACT: longitudinal creepage > 0 of a driving wheel; "vehicle": of most vehicle codes, (V -
    omega r)/V: longitudinal creepage > 0 of a braking wheel."""
    theory: Literal["strip", "fastrip", "fastsim", "linear"] | None = None
    """Theory of the shear. Default: "strip"; only with kind = "rolling". "strip": strips of
    Carter's form by Kalker's strip theory, scaled to his coefficients; "fastrip": the same with the
    shear of Sichani et al. 2016; "fastsim": Kalker's simplified theory with a parabolic limit of
    the shear; "linear": Kalker's linear theory; its force is distributed like the pressure."""
    coupled: bool | None = None
    """Whether the wheel feels the cracks: the pressure is that of a smooth elastic wheel on the
    cracked rail, as a line contact (of an ellipse, the strip at lateral_mm). Plane engines and
    half-plane only. Default: False; only with kind = "hertz" or "carter" or "rolling"."""
    surface_nodes_per_half_width: Count | None = None
    """Surface nodes per half-width of a coupled wheel, denser at the mouths; by default 40.
    Accepted: 10 to 160; only with kind = "hertz" or "carter" or "rolling"."""
    coupled_within_over_a: Number | None = None
    """Distance of the contact centre from the nearest mouth up to which a coupled wheel feels the
    cracks; by default 3. In a; accepted: 1.5 to 12; only with kind = "hertz" or "carter" or
    "rolling"."""


@dataclass(frozen=True, repr=False)
class Hertz(Section):
    """Wheel-rail contact; one passage is one axle. Pressure p0 sqrt(1 - (x - xc)^2 / a^2) and a
    shear proportional to it: full sliding."""

    _section: ClassVar[str] = "contact"
    _fixed: ClassVar[dict[str, str]] = {"kind": "hertz"}
    peak_pressure_mpa: Number | None = None
    """Peak pressure p0. In MPa; usual: 50 to 4000; accepted: 0.001 to 10000."""
    half_width_mm: Number | None = None
    """Half-width a of the contact. In mm; usual: 0.3 to 30; accepted: 0.01 to 100."""
    friction: Number | None = None
    """Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an
    upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a
    wheel braking towards +x). Usual: 0.001 to 0.8; accepted: -1 to 1."""
    _: KW_ONLY
    line_load_n_per_mm: Number | None = None
    """Wheel load per unit width. In N/mm; usual: 100 to 1e5; accepted: 1e-5 to 1e7."""
    wheel_radius_mm: Number | None = None
    """Radius of the wheel. In mm; usual: 150 to 700; accepted: 0.01 to 1e5."""
    rail_radius_mm: Number | None = None
    """Longitudinal radius of the rail; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01."""
    wheel_load_kn: Number | None = None
    """Wheel load; with the radii it defines the contact ellipse. In kN; usual: 1 to 300; accepted:
    0.001 to 10000."""
    rail_head_radius_mm: Number | None = None
    """Transverse radius of the rail head; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01."""
    wheel_profile_radius_mm: Number | None = None
    """Transverse radius of the wheel profile; inf if straight, negative if concave. In mm; usual: 5
    to 1e6; accepted: from -1e6."""
    lateral_half_width_mm: Number | None = None
    """Lateral semi-axis b of the contact ellipse; without it the contact is a line contact, which
    the space engine refuses. In mm; usual: 0.3 to 30; accepted: 0.1 to 1000."""
    lateral_mm: Number | None = None
    """Lateral position of the ellipse relative to the cracks, by default 0; with rolling, y of the
    crack in the patch; with profiles, y of the crack on rail_profile, by default under the most
    loaded patch. In mm; accepted: -100 to 100."""
    lateral: Literal["patch", "strip"] | None = None
    """Part of the contact that loads cracks in the plane: by default the patch, in a block or with
    coupled the strip. "patch": averaged along the crack front; "strip": at lateral_mm, as a line
    contact."""
    torque: Literal["driven", "braked"] | None = None
    """Direction of the shear; friction then has no sign. "driven": drags the rail backwards;
    "braked": drags the rail forwards."""
    lateral_friction: Number | None = None
    """Ratio of lateral shear to pressure, > 0 towards +z; by default 0. In the plane it has no
    effect at lateral_mm = 0. Usual: 0.001 to 0.8; accepted: -1 to 1."""
    coupled: bool | None = None
    """Whether the wheel feels the cracks: the pressure is that of a smooth elastic wheel on the
    cracked rail, as a line contact (of an ellipse, the strip at lateral_mm). Plane engines and
    half-plane only. Default: False."""
    surface_nodes_per_half_width: Count | None = None
    """Surface nodes per half-width of a coupled wheel, denser at the mouths; by default 40.
    Accepted: 10 to 160."""
    coupled_within_over_a: Number | None = None
    """Distance of the contact centre from the nearest mouth up to which a coupled wheel feels the
    cracks; by default 3. In a; accepted: 1.5 to 12."""


@dataclass(frozen=True, repr=False, kw_only=True)
class Carter(Section):
    """Wheel-rail contact; one passage is one axle. The same pressure in partial slip, with a stick
    zone behind the leading edge."""

    _section: ClassVar[str] = "contact"
    _fixed: ClassVar[dict[str, str]] = {"kind": "carter"}
    peak_pressure_mpa: Number | None = None
    """Peak pressure p0. In MPa; usual: 50 to 4000; accepted: 0.001 to 10000."""
    half_width_mm: Number | None = None
    """Half-width a of the contact. In mm; usual: 0.3 to 30; accepted: 0.01 to 100."""
    line_load_n_per_mm: Number | None = None
    """Wheel load per unit width. In N/mm; usual: 100 to 1e5; accepted: 1e-5 to 1e7."""
    wheel_radius_mm: Number | None = None
    """Radius of the wheel. In mm; usual: 150 to 700; accepted: 0.01 to 1e5."""
    rail_radius_mm: Number | None = None
    """Longitudinal radius of the rail; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01."""
    wheel_load_kn: Number | None = None
    """Wheel load; with the radii it defines the contact ellipse. In kN; usual: 1 to 300; accepted:
    0.001 to 10000."""
    rail_head_radius_mm: Number | None = None
    """Transverse radius of the rail head; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01."""
    wheel_profile_radius_mm: Number | None = None
    """Transverse radius of the wheel profile; inf if straight, negative if concave. In mm; usual: 5
    to 1e6; accepted: from -1e6."""
    lateral_half_width_mm: Number | None = None
    """Lateral semi-axis b of the contact ellipse; without it the contact is a line contact, which
    the space engine refuses. In mm; usual: 0.3 to 30; accepted: 0.1 to 1000."""
    lateral_mm: Number | None = None
    """Lateral position of the ellipse relative to the cracks, by default 0; with rolling, y of the
    crack in the patch; with profiles, y of the crack on rail_profile, by default under the most
    loaded patch. In mm; accepted: -100 to 100."""
    lateral: Literal["patch", "strip"] | None = None
    """Part of the contact that loads cracks in the plane: by default the patch, in a block or with
    coupled the strip. "patch": averaged along the crack front; "strip": at lateral_mm, as a line
    contact."""
    friction: Number | None = None
    """Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an
    upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a
    wheel braking towards +x). Usual: 0.001 to 0.8; accepted: -1 to 1."""
    traction: Number | None = None
    """Traction ratio Q/(friction P), signed like the shear on the rail along +x: < 0 drives a wheel
    towards +x; 1 and -1 are full sliding. Accepted: -1 to 1."""
    coupled: bool | None = None
    """Whether the wheel feels the cracks: the pressure is that of a smooth elastic wheel on the
    cracked rail, as a line contact (of an ellipse, the strip at lateral_mm). Plane engines and
    half-plane only. Default: False."""
    surface_nodes_per_half_width: Count | None = None
    """Surface nodes per half-width of a coupled wheel, denser at the mouths; by default 40.
    Accepted: 10 to 160."""
    coupled_within_over_a: Number | None = None
    """Distance of the contact centre from the nearest mouth up to which a coupled wheel feels the
    cracks; by default 3. In a; accepted: 1.5 to 12."""


@dataclass(frozen=True, repr=False, kw_only=True)
class ContactTable(Section):
    """Wheel-rail contact; one passage is one axle. Pressure and shear from a table, measured or
    computed."""

    _section: ClassVar[str] = "contact"
    _fixed: ClassVar[dict[str, str]] = {"kind": "table"}
    profile: File | None = None
    """CSV file with the columns u_mm,p_mpa,q_mpa, u from the wheel centre along +x, linear between
    rows; or a .mat file of the program CONTACT."""
    scale: Number | None = None
    """Factor on pressure and shear. Accepted: 1e-6 to 1e6; default: 1.0."""
    strip_mm: Number | None = None
    """Lateral position, in CONTACT's frame, of the strip of a .mat file. In mm; accepted: -1000 to
    1000."""
    friction: Number | None = None
    """Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an
    upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a
    wheel braking towards +x). Usual: 0.001 to 0.8; accepted: -1 to 1."""


@dataclass(frozen=True, repr=False, kw_only=True)
class Rolling(Section):
    """Wheel-rail contact; one passage is one axle. A hertz ellipse in rolling contact, from normal
    force, creepages and spin."""

    _section: ClassVar[str] = "contact"
    _fixed: ClassVar[dict[str, str]] = {"kind": "rolling"}
    wheel_radius_mm: Number | None = None
    """Radius of the wheel. In mm; usual: 150 to 700; accepted: 0.01 to 1e5."""
    rail_head_radius_mm: Number | None = None
    """Transverse radius of the rail head; inf if flat. In mm; usual: 5 to 1e6; accepted: from 0.01."""
    wheel_profile_radius_mm: Number | None = None
    """Transverse radius of the wheel profile; inf if straight, negative if concave. In mm; usual: 5
    to 1e6; accepted: from -1e6."""
    lateral_mm: Number | None = None
    """Lateral position of the ellipse relative to the cracks, by default 0; with rolling, y of the
    crack in the patch; with profiles, y of the crack on rail_profile, by default under the most
    loaded patch. In mm; accepted: -100 to 100."""
    lateral: Literal["patch", "strip"] | None = None
    """Part of the contact that loads cracks in the plane: by default the patch, in a block or with
    coupled the strip. "patch": averaged along the crack front; "strip": at lateral_mm, as a line
    contact."""
    friction: Number | None = None
    """Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an
    upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a
    wheel braking towards +x). Usual: 0.001 to 0.8; accepted: -1 to 1."""
    normal_kn: Number | None = None
    """Normal force; with profiles, the sum over the patches. In kN; usual: 1 to 300; accepted:
    0.001 to 10000."""
    semi_axes_mm: Numbers | None = None
    """Semi-axes [a, b] of the contact ellipse, along and across the rail. In mm; usual: 0.3 to 30;
    accepted: 0.01 to 100."""
    rail_profile: File | None = None
    """CSV file with the points y_mm,z_mm of the rail head in order, z downwards; or two columns
    without a header, or a file of MiniProf (.ban) or Simpack (.prr)."""
    wheel_profile: File | None = None
    """Wheel profile in the axes and formats of rail_profile (.whl, .prw); wheel_radius_mm is the
    radius at z = 0."""
    rail_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None = None
    """Axes of rail_profile, after those that a Simpack file states; by default z-down, in MiniProf
    files also z-up. "z-down": y and z as those of the rail here; "z-up": z points upwards;
    "mirrored": y points to the other side; "mirrored-z-up": both."""
    wheel_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None = None
    """Axes of wheel_profile, likewise. "z-down": y and z as those of the rail here; "z-up": z
    points upwards; "mirrored": y points to the other side; "mirrored-z-up": both."""
    profile_smoothing_mm: Number | None = None
    """Half the length of the parabolas fitted to the profiles; about 3 for measured points with
    scatter. In mm; accepted: 0.01 to 20; default: 1.0."""
    shift_mm: Number | None = None
    """y of the origin of wheel_profile on rail_profile. In mm; accepted: -200 to 200; default: 0.0."""
    yaw_deg: Number | None = None
    """Angle of attack of the wheel, > 0 towards +y. In degrees; usual: 0 to 5; accepted: -10 to 10;
    default: 0.0."""
    roll_deg: Number | None = None
    """Rotation of wheel_profile about its origin; > 0 lowers +y. In degrees; usual: 0 to 5;
    accepted: -10 to 10; default: 0.0."""
    creepage_x: Number | None = None
    """Longitudinal creepage, signed by creepage_sign. Usual: 0 to 0.05; accepted: -1 to 1; default:
    0.0."""
    creepage_y: Number | None = None
    """Lateral creepage. Usual: 0 to 0.05; accepted: -1 to 1; default: 0.0."""
    spin_per_mm: Number | None = None
    """Spin creepage; with creepage_sign = "contact", > 0 turns +x (travel) towards +y. In 1/mm;
    usual: 0 to 0.00666667; accepted: -1 to 1; default: 0.0."""
    creepage_sign: Literal["contact", "vehicle"] | None = None
    """Sign convention of creepages and spin. "contact": of the program CONTACT: longitudinal
    creepage > 0 of a driving wheel; "vehicle": of most vehicle codes, (V - omega r)/V: longitudinal
    creepage > 0 of a braking wheel."""
    theory: Literal["strip", "fastrip", "fastsim", "linear"] | None = None
    """Theory of the shear. Default: "strip". "strip": strips of Carter's form by Kalker's strip
    theory, scaled to his coefficients; "fastrip": the same with the shear of Sichani et al. 2016;
    "fastsim": Kalker's simplified theory with a parabolic limit of the shear; "linear": Kalker's
    linear theory; its force is distributed like the pressure."""
    coupled: bool | None = None
    """Whether the wheel feels the cracks: the pressure is that of a smooth elastic wheel on the
    cracked rail, as a line contact (of an ellipse, the strip at lateral_mm). Plane engines and
    half-plane only. Default: False."""
    surface_nodes_per_half_width: Count | None = None
    """Surface nodes per half-width of a coupled wheel, denser at the mouths; by default 40.
    Accepted: 10 to 160."""
    coupled_within_over_a: Number | None = None
    """Distance of the contact centre from the nearest mouth up to which a coupled wheel feels the
    cracks; by default 3. In a; accepted: 1.5 to 12."""


class ContactKeys(TypedDict, total=False):
    """Keys of `contact`, those of `Contact`."""

    kind: Literal["hertz", "carter", "table", "rolling"] | None
    peak_pressure_mpa: Number | None
    half_width_mm: Number | None
    line_load_n_per_mm: Number | None
    wheel_radius_mm: Number | None
    rail_radius_mm: Number | None
    wheel_load_kn: Number | None
    rail_head_radius_mm: Number | None
    wheel_profile_radius_mm: Number | None
    lateral_half_width_mm: Number | None
    lateral_mm: Number | None
    lateral: Literal["patch", "strip"] | None
    profile: File | None
    scale: Number | None
    strip_mm: Number | None
    friction: Number | None
    torque: Literal["driven", "braked"] | None
    lateral_friction: Number | None
    traction: Number | None
    normal_kn: Number | None
    semi_axes_mm: Numbers | None
    rail_profile: File | None
    wheel_profile: File | None
    rail_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None
    wheel_profile_axes: Literal["z-down", "z-up", "mirrored", "mirrored-z-up"] | None
    profile_smoothing_mm: Number | None
    shift_mm: Number | None
    yaw_deg: Number | None
    roll_deg: Number | None
    creepage_x: Number | None
    creepage_y: Number | None
    spin_per_mm: Number | None
    creepage_sign: Literal["contact", "vehicle"] | None
    theory: Literal["strip", "fastrip", "fastsim", "linear"] | None
    coupled: bool | None
    surface_nodes_per_half_width: Count | None
    coupled_within_over_a: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Track(Section):
    """Bending of the rail on its foundation under the passing axles."""

    _section: ClassVar[str] = "track"
    wheel_load_kn: Number | None = None
    """Wheel load on this rail; by default that of [contact]. In kN; usual: 1 to 300; accepted:
    0.001 to 10000."""
    foundation_mpa: Number | None = None
    """Foundation modulus k, N/mm per mm of deflection of one rail. In MPa; usual: 2 to 500;
    accepted: 0.01 to 1e5; default: 50.0."""
    section: Literal["60E1", "54E1", "49E1", "UIC60", "UIC54", "S49"] | None = None
    """Rail section. "60E1": 60 kg/m; "54E1": 54 kg/m; "49E1": 49 kg/m; "UIC60": older name;
    "UIC54": older name; "S49": older name."""
    second_moment_mm4: Number | None = None
    """Second moment of area about the horizontal axis. In mm^4; usual: 2e6 to 6e7; accepted: 1000
    to 1e10."""
    neutral_axis_depth_mm: Number | None = None
    """Depth of the neutral axis below the running surface. In mm; usual: 40 to 130; accepted: 1 to
    10000."""
    axles_mm: Numbers | None = None
    """Positions of its own and other axles along +x, relative to this wheel. In mm; usual: 500 to
    1e6; accepted: -1e6 to 1e6; default: [0.0]."""
    axle_loads_kn: Numbers | None = None
    """Wheel load of each axle; by default wheel_load_kn. In kN; usual: 1 to 300; accepted: 0.001 to
    10000."""


class TrackKeys(TypedDict, total=False):
    """Keys of `track`, those of `Track`."""

    wheel_load_kn: Number | None
    foundation_mpa: Number | None
    section: Literal["60E1", "54E1", "49E1", "UIC60", "UIC54", "S49"] | None
    second_moment_mm4: Number | None
    neutral_axis_depth_mm: Number | None
    axles_mm: Numbers | None
    axle_loads_kn: Numbers | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Temperature(Section):
    """Temperature of a rail that is restrained lengthwise, in tension below neutral_c."""

    _section: ClassVar[str] = "temperature"
    rail_c: Number | None = None
    """Temperature of the rail. In degrees C; usual: 0 to 75; accepted: -200 to 200."""
    seasons_c: Numbers | None = None
    """Temperatures of the rail over the year; each wheel passes at each of them, as a mix, with the
    toughness at that temperature. In degrees C; usual: 0 to 75; accepted: -200 to 200."""
    season_shares: Numbers | None = None
    """Shares of the axles at seasons_c; their sum is 1. Accepted: 1e-9 to 1."""
    neutral_c: Number
    """Neutral temperature, at which there is no longitudinal force. In degrees C; usual: 0 to 50;
    accepted: -200 to 200."""
    expansion_per_k: Number | None = None
    """Coefficient of thermal expansion. In 1/K; usual: 1e-5 to 1.4e-5; accepted: 1e-9 to 0.001;
    default: 1.15e-05."""


class TemperatureKeys(TypedDict, total=False):
    """Keys of `temperature`, those of `Temperature`."""

    rail_c: Number | None
    seasons_c: Numbers | None
    season_shares: Numbers | None
    neutral_c: Number | None
    expansion_per_k: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Wheel(Section):
    """A wheel of a traffic mix, instead of [contact]; growth rates are summed by the shares of the
    axles."""

    _section: ClassVar[str] = "wheel"
    name: str | None = None
    """Name shown in reports."""
    share: Number | None = None
    """Fraction of all axles; the shares add up to 1. Accepted: 1e-9 to 1."""
    axle_load_t: Number | None = None
    """Axle load for the count of tonnes; by default that of [traffic]. In t; usual: 3 to 45;
    accepted: 0.001 to 100."""
    direction: Literal["+x", "-x"] | None = None
    """Direction of travel, by default that of [passage]; in the other one the passage is mirrored,
    but not the sign of friction. "+x": towards +x; "-x": towards -x."""
    table: File | None = None
    """CSV file with a row per wheel and patch: wheel, normal_kn, y_rail_mm (on the axis of
    lateral_mm of the cracks), creepage_x, creepage_y, spin_per_mm, mu, and a_mm, b_mm or
    rail_radius_mm, wheel_radius_mm; optionally place_m, patch, share, axle_load_t, angle_deg, x_mm,
    wheel_profile_radius_mm."""
    creepage_sign: Literal["contact", "vehicle"] | None = None
    """Sign convention of creepages and spin. "contact": of the program CONTACT: longitudinal
    creepage > 0 of a driving wheel; "vehicle": of most vehicle codes, (V - omega r)/V: longitudinal
    creepage > 0 of a braking wheel."""
    theory: Literal["strip", "fastrip", "fastsim", "linear"] | None = None
    """Theory of the shear. Default: "strip". "strip": strips of Carter's form by Kalker's strip
    theory, scaled to his coefficients; "fastrip": the same with the shear of Sichani et al. 2016;
    "fastsim": Kalker's simplified theory with a parabolic limit of the shear; "linear": Kalker's
    linear theory; its force is distributed like the pressure."""
    lateral: Literal["patch", "strip"] | None = None
    """Part of the patches that loads cracks in the plane: by default the patch, in a block the
    strip. "patch": averaged along the crack front; "strip": at lateral_mm, as a line contact."""
    representatives: Count | None = None
    """Largest number of computed wheels; more are grouped, and one of each group is computed.
    Accepted: 1 to 30; default: 30."""
    representatives_error: Number | None = None
    """Error of the mean growth rate by the representatives above which there is a warning.
    Accepted: 1e-6 to 1; default: 0.01."""
    place_m: Number | None = None
    """Place along the track: only wheels at this place pass, with shares among them; by default all
    wheels. In m; accepted: -1e7 to 1e7."""
    place_window_m: Number | None = None
    """Length of track around place_m that counts as this place. In m; accepted: 0.001 to 1e7;
    default: 1.0."""
    contact: Contact | Hertz | Carter | ContactTable | Rolling | ContactKeys | None = None
    """Wheel-rail contact; one passage is one axle."""
    track: Track | TrackKeys | None = None
    """Bending of the rail on its foundation under the passing axles."""
    temperature: Temperature | TemperatureKeys | None = None
    """Temperature of a rail that is restrained lengthwise, in tension below neutral_c."""
    fluid: Literal[False] | Fluid | FluidKeys | None = None
    """Pressure of water or grease in the cracks."""


class WheelKeys(TypedDict, total=False):
    """Keys of `wheel`, those of `Wheel`."""

    name: str | None
    share: Number | None
    axle_load_t: Number | None
    direction: Literal["+x", "-x"] | None
    table: File | None
    creepage_sign: Literal["contact", "vehicle"] | None
    theory: Literal["strip", "fastrip", "fastsim", "linear"] | None
    lateral: Literal["patch", "strip"] | None
    representatives: Count | None
    representatives_error: Number | None
    place_m: Number | None
    place_window_m: Number | None
    contact: Contact | Hertz | Carter | ContactTable | Rolling | ContactKeys | None
    track: Track | TrackKeys | None
    temperature: Temperature | TemperatureKeys | None
    fluid: Literal[False] | Fluid | FluidKeys | None


@dataclass(frozen=True, repr=False, kw_only=True)
class PassageSettings(Section):
    """Passage of the wheel, towards -x if from_over_a > to_over_a."""

    _section: ClassVar[str] = "passage"
    from_over_a: Number | None = None
    """First position of the contact centre, relative to the mouth met first. In a; accepted: -1000
    to 1000; default: -6.0."""
    to_over_a: Number | None = None
    """Last position of the contact centre, relative to the mouth met last. In a; accepted: -1000 to
    1000; default: 6.0."""
    positions: Count | None = None
    """Number of evenly spaced output positions. Accepted: 2 to 1e5; default: 241."""
    max_passages: Count | None = None
    """Maximum number of passages over an unchanged crack until K repeats. Accepted: 1 to 1000;
    default: 5."""
    passage_tolerance: Number | None = None
    """Change of K between two passages, relative to its peak, below which it counts as repeating.
    Accepted: 1e-9 to 0.1; default: 0.001."""
    step_tolerance: Number | None = None
    """Change of K, relative to its peak, to which load steps are refined. Accepted: 1e-6 to 0.1;
    default: 0.002."""
    network_tolerance: Number | None = None
    """Estimated error of K, relative to its peak at the tip, at which sweeps with solver.network =
    "groups" end. Accepted: 1e-9 to 0.1; default: 0.0006."""
    step_control: Literal["adaptive", "fixed"] | None = None
    """Control of the load steps. Default: "adaptive". "adaptive": changes of contact status are
    resolved one after another, and load steps are refined to step_tolerance; "fixed": one load step
    between successive output positions."""


class PassageSettingsKeys(TypedDict, total=False):
    """Keys of `passage`, those of `PassageSettings`."""

    from_over_a: Number | None
    to_over_a: Number | None
    positions: Count | None
    max_passages: Count | None
    passage_tolerance: Number | None
    step_tolerance: Number | None
    network_tolerance: Number | None
    step_control: Literal["adaptive", "fixed"] | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Crack(Section):
    """A crack or a row of cracks."""

    _section: ClassVar[str] = "crack"
    mouth_mm: Number | None = None
    """x of the crack mouth. In mm; accepted: -1e6 to 1e6."""
    length_mm: Number | None = None
    """Length of a straight crack. In mm; usual: 0.05 to 200; accepted: 0.001 to 10000."""
    depth_mm: Number | None = None
    """Tip depth of a straight crack: length_mm = depth_mm/sin(angle_deg). In mm; usual: 0.05 to
    200; accepted: 0.001 to 10000."""
    angle_deg: Number | None = None
    """Angle of the crack below the surface, measured from +x. In degrees; usual: 2 to 178;
    accepted: 0.5 to 179.5."""
    points_mm: Sequence[Numbers] | Numbers | None = None
    """Polyline from the surface (y = 0), or from below it for a buried crack with two tips. In
    space two points, or three of a folded crack: mouth, fold, deepest point. In mm."""
    table: File | None = None
    """CSV file with a row per crack: mouth_mm, or position_m along the track (smallest at x = 0);
    depth_mm or length_mm, a number or a class such as 0.5-1.0 (its upper end counts), or
    at_most_mm; optionally surface_length_mm (twice surface_half_length_mm), angle_deg and
    lateral_mm, by default those of the section."""
    friction: Number
    """Crack-face friction coefficient. Usual: 0.001 to 1; accepted: 0 to 2."""
    surface_half_length_mm: Number | None = None
    """Semi-axis of a semi-elliptical crack along the surface; length_mm is the other one. Required
    in space. In the plane the crack keeps this shape, with K of its deepest point; by default it is
    long along the surface. In mm; usual: 0.05 to 200; accepted: 0.001 to 10000."""
    lateral_mm: Number | None = None
    """Lateral position of the crack and its copies, in space or under a table of wheels; by default
    0. In mm; accepted: -1000 to 1000."""
    strike_deg: Number | None = None
    """Rotation of the crack about the vertical, only in space; by default 0. A crack with angle_deg
    < 90 descends towards +x at 0, +z (lateral) at 90. In degrees; accepted: -180 to 180."""
    count: Count | None = None
    """Number of cracks in a row towards +x. Accepted: 1 to 256; default: 1."""
    spacing_mm: Number | None = None
    """Distance from one crack of the row to the next; required when count > 1. In mm; usual: 0.2 to
    1000; accepted: above 0 to 10000."""
    length_sd_mm: Number | None = None
    """Standard deviation of the lengths of a row of straight cracks (normal, truncated at three
    deviations); by default 0. In mm; accepted: 0 to 1000."""
    angle_sd_deg: Number | None = None
    """Standard deviation of the angles of a row, likewise; by default 0. In degrees; accepted: 0 to
    60."""
    spacing_sd_mm: Number | None = None
    """Standard deviation of spacing_mm, likewise; by default 0. In mm; accepted: 0 to 1000."""
    seed: Count | None = None
    """Seed of the scatter of a row; its first cracks do not depend on count. Accepted: 0 to 1e9."""


class CrackKeys(TypedDict, total=False):
    """Keys of `crack`, those of `Crack`."""

    mouth_mm: Number | None
    length_mm: Number | None
    depth_mm: Number | None
    angle_deg: Number | None
    points_mm: Sequence[Numbers] | Numbers | None
    table: File | None
    friction: Number | None
    surface_half_length_mm: Number | None
    lateral_mm: Number | None
    strike_deg: Number | None
    count: Count | None
    spacing_mm: Number | None
    length_sd_mm: Number | None
    angle_sd_deg: Number | None
    spacing_sd_mm: Number | None
    seed: Count | None


@dataclass(frozen=True, repr=False, kw_only=True)
class ResidualStress(Section):
    """A balanced residual stress over depth, added to that of the wheel."""

    _section: ClassVar[str] = "residual_stress"
    profile: File
    """CSV file with the columns depth_mm,sxx_mpa[,szz_mpa]; linear between rows, zero below the
    last."""


class ResidualStressKeys(TypedDict, total=False):
    """Keys of `residual_stress`, those of `ResidualStress`."""

    profile: File | None


@dataclass(frozen=True, repr=False, kw_only=True)
class PlasticStress(Section):
    """A plastic stress 2 G eps_p, which the run balances. Without a file, that of the stabilised
    state of [shakedown]; under a patch, the balanced stress of that state."""

    _section: ClassVar[str] = "plastic_stress"
    field: File | None = None
    """VTU file with plastic_stress_mpa at points or cells, such as that of `railcrack shakedown`."""
    profile: File | None = None
    """CSV file in the format of [residual_stress], read as a plastic stress."""


class PlasticStressKeys(TypedDict, total=False):
    """Keys of `plastic_stress`, those of `PlasticStress`."""

    field: File | None
    profile: File | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Fluid(Section):
    """Pressure of water or grease in the cracks."""

    _section: ClassVar[str] = "fluid"
    model: Literal["none", "mouth", "trapped"]
    """Model of the fluid pressure. "none": dry cracks, for studies; "mouth": the contact pressure
    over the mouth acts inside the crack; "trapped": the fluid in the crack is enclosed while the
    contact covers its mouth."""
    profile: Literal["linear", "constant"] | None = None
    """Pressure at the distance s from the mouth; l is the crack length. Default: "linear"; only
    with model = "mouth". "linear": p(s) = p(mouth) (1 - s/l); "constant": p(s) = p(mouth)."""
    pressure_cap_mpa: Number | None = None
    """Upper limit of the pressure; inf lets it lift the flap above a shallow crack off the rail.
    Not under a coupled wheel. In MPa; usual: 1 to 4000; accepted: from 0.001; only with model =
    "mouth"."""
    bulk_modulus_mpa: Number | None = None
    """Bulk modulus B of the fluid, V = V0 exp(-p/B): 2200 for water, inf if incompressible. In MPa;
    usual: 100 to 5000; accepted: from 10; only with model = "trapped"."""
    leak: bool | None = None
    """Whether fluid above the pressure over the mouth leaks out once no closed faces block its
    path. Default: True; only with model = "trapped"."""
    cracks: Numbers | None = None
    """Numbers of the cracks with fluid, from 1 and including copies; by default all. Joined cracks
    share it. Accepted: 1 to 10000."""


class FluidKeys(TypedDict, total=False):
    """Keys of `fluid`, those of `Fluid`."""

    model: Literal["none", "mouth", "trapped"] | None
    profile: Literal["linear", "constant"] | None
    pressure_cap_mpa: Number | None
    bulk_modulus_mpa: Number | None
    leak: bool | None
    cracks: Numbers | None


@dataclass(frozen=True, repr=False, kw_only=True)
class ShakedownSettings(Section):
    """Plasticity of the rail under repeated passages, and the Dang Van criterion."""

    _section: ClassVar[str] = "shakedown"
    yield_stress_mpa: Number | None = None
    """Cyclic yield stress in tension, by default that of the steel of [growth] if it names one; not
    with steel. In MPa; usual: 100 to 1500; accepted: 1 to 10000; default: 500.0."""
    steel: Literal["R260", "R350HT"] | None = None
    """Rail steel with its monotonic 0.2 % proof stress as yield stress (docs/parameters.md).
    "R260": 480 MPa; "R350HT": 800 MPa."""
    hardening_modulus_mpa: Number | None = None
    """Modulus C of the linear kinematic hardening X = (2/3) C eps_p. In MPa; usual: 500 to 2e5;
    accepted: 1 to 1e7; default: 20000.0."""
    method: Literal["pass-by-pass", "direct"] | None = None
    """Method for the stabilised state. Default: "pass-by-pass". "pass-by-pass": each passage starts
    from the state left by the previous one; "direct": the downstream state becomes the upstream
    state in every iteration: cheaper, but possibly a different admissible state."""
    wheels: Literal["in turn", "heaviest"] | None = None
    """Wheels of a mix that roll the rail; a line contact is that of the heaviest alone. Default:
    "in turn". "in turn": all, each at its lateral place, the heaviest first; "heaviest": only the
    wheel nearest to its limit of elastic shakedown."""
    max_passes: Count | None = None
    """Passages after which the rail counts as not stabilised. Accepted: 1 to 1e5; default: 500."""
    initial_residual: File | None = None
    """Balanced stress before the first passage, in the format of [residual_stress] profile."""
    dang_van_a: Number | None = None
    """Slope of the Dang Van criterion. Accepted: 0 to 10; default: 0.3."""
    dang_van_b_mpa: Number | None = None
    """Fatigue limit in pure shear of the Dang Van criterion. In MPa; usual: 100 to 1500; accepted:
    0.1 to 10000; default: 250.0."""


class ShakedownSettingsKeys(TypedDict, total=False):
    """Keys of `shakedown`, those of `ShakedownSettings`."""

    yield_stress_mpa: Number | None
    steel: Literal["R260", "R350HT"] | None
    hardening_modulus_mpa: Number | None
    method: Literal["pass-by-pass", "direct"] | None
    wheels: Literal["in turn", "heaviest"] | None
    max_passes: Count | None
    initial_residual: File | None
    dang_van_a: Number | None
    dang_van_b_mpa: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Growth(Section):
    """Crack growth: da/dN by an equivalent range dKeq of dKI and dKII."""

    _section: ClassVar[str] = "growth"
    steps: Count | None = None
    """Largest number of increments, apart from grindings and increments cut short; 0 computes the
    initial cracks only. By default 25; with critical_depth_mm, critical_length_mm, [fracture] or
    stop_after_cycles, until the answer is known, at most 1000. Accepted: 0 to 10000."""
    increment: Number | None = None
    """Increment of the fastest tip, as a fraction of its crack's length; by default chosen for the
    tolerance, or 0.04 with turning = "kink". Accepted: 1e-4 to 0.5."""
    tolerance: Number | None = None
    """Allowed relative error of the life by the increments, by default 0.01; not with increment or
    turning = "kink". Accepted: 1e-5 to 0.2."""
    turning: Literal["smooth", "kink"] | None = None
    """How a path turns towards the best kink of the direction criterion. Default: "smooth".
    "smooth": over turning_length_mm; "kink": by a whole kink in each increment, on which the path
    depends."""
    turning_length_mm: Number | None = None
    """Length l over which a path turns by its best kink theta*, dtheta/ds = theta*/l. inf: straight
    ahead; 0: the limit path, where theta* is zero. In mm; usual: 0.01 to 50; accepted: from 0;
    default: 0.5; only with turning = "smooth"."""
    straight_to_mm: Number | None = None
    """Tip depth down to which a path goes straight ahead, 2 to 3 in measured head checks; by
    default 2.5 with [inspection] and without turning_length_mm, otherwise 0. In space only with
    surface = "turned". In mm; usual: 0.05 to 50; accepted: 0 to 1000; only with turning = "smooth"."""
    kink_angle_deg: Number | None = None
    """Best kink from which a path kinks at once. In deg; accepted: 1 to 110; default: 30.0; only
    with turning = "smooth"."""
    kink_friction: Number | None = None
    """Friction coefficient of the virtual kinks that decide the direction. Usual: 0.001 to 1;
    accepted: 0 to 10; default: 0.0."""
    law: Literal["paris", "paris-threshold", "bold", "walker", "forman", "nasgro", "table"] | None = None
    """Growth law. Default: "paris". "paris": C dKeq^m above the threshold; "paris-threshold": C
    (dKeq^m - dKth^m); "bold": C (dKeq^3.74 - 4^3.74), Bold, Brown and Allen 1991; "walker": C [dKeq
    / (1-R)^(1-gamma)]^m above the threshold; "forman": C dKeq^m / ((1-R) Kc - dKeq) above the
    threshold; "nasgro": with closure, threshold and toughness; "table": measured rates."""
    equivalent: Literal["hourlier-pineau", "tanaka", "richard"] | None = None
    """Equivalent range dKeq. Default: "hourlier-pineau"; only with law = "paris" or
    "paris-threshold" or "walker" or "forman" or "nasgro" or "table". "hourlier-pineau": sqrt(dKI^2
    + w dKII^2); "tanaka": (dKI^4 + 8 dKII^4)^(1/4); "richard": dKI/2 + sqrt(dKI^2 + 4 (1.155
    dKII)^2)/2."""
    paris_c: Number | None = None
    """Coefficient C of the law; at dKeq = 10 MPa sqrt(m) the rate is at most a millimetre per
    cycle. In mm/cycle, MPa sqrt(m); accepted: 1e-30 to 1; default: 2e-09; only with law = "paris"
    or "paris-threshold"."""
    paris_m: Number | None = None
    """Exponent m of the law. Usual: 1.5 to 7; accepted: 0.1 to 20; default: 3.33; only with law =
    "paris" or "paris-threshold"."""
    mode_2_weight: Number | None = None
    """Weight w of mode II. Usual: 0.1 to 10; accepted: 0 to 100; default: 0.772; only with
    equivalent = "hourlier-pineau"."""
    mode_3_weight: Number | None = None
    """Weight of mode III in space; by default mode_2_weight/(1 - nu). Usual: 0.1 to 10; accepted: 0
    to 100; only with equivalent = "hourlier-pineau"."""
    front: Literal["ellipse", "free"] | None = None
    """Shape of the crack fronts; only in space. Default: "ellipse". "ellipse": the ellipse nearest
    to the local rates; "free": the front follows the local rates, smoothed by front_harmonics."""
    surface: Literal["plane", "turned"] | None = None
    """Surface of the cracks; only in space. Default: "plane". "plane": the crack keeps its plane, a
    folded one that of its branch; "turned": the crack turns as a path in the plane, about the
    direction of its mouth."""
    front_harmonics: Count | None = None
    """Harmonics of a free front, an even number; it has a node every 180/front_harmonics degrees.
    Accepted: 2 to 8; default: 6; only with front = "free"."""
    threshold_mpa_sqrt_m: Number | None = None
    """Threshold of dKeq, at or below which a crack does not grow. In MPa sqrt(m); usual: 0.5 to 20;
    accepted: 0 to 1000; default: 0.0; only with law = "paris" or "paris-threshold" or "walker" or
    "forman"."""
    bold_c: Number | None = None
    """Coefficient C of C (dKeq^3.74 - 4^3.74). In mm/cycle, MPa sqrt(m); accepted: 1e-30 to 1;
    default: 5.07e-10; only with law = "bold"."""
    walker_c: Number | None = None
    """Coefficient C of C [dKeq / (1-R)^(1-gamma)]^m. In mm/cycle, MPa sqrt(m); accepted: 1e-30 to
    1; default: 2e-09; only with law = "walker"."""
    walker_m: Number | None = None
    """Exponent m. Usual: 1.5 to 7; accepted: 0.1 to 20; default: 3.33; only with law = "walker"."""
    walker_gamma: Number | None = None
    """Exponent gamma: 1 is Paris' law, 0 a law of the largest K. Accepted: 0 to 1; default: 0.6;
    only with law = "walker"."""
    forman_c: Number | None = None
    """Coefficient C of C dKeq^m / ((1-R) Kc - dKeq). In mm/cycle, MPa sqrt(m); accepted: 1e-30 to
    1000; default: 5e-08; only with law = "forman"."""
    forman_m: Number | None = None
    """Exponent m. Usual: 1.5 to 7; accepted: 0.1 to 20; default: 3.0; only with law = "forman"."""
    forman_kc: Number | None = None
    """Kc, at which the crack runs away: the run ends with fracture. In MPa sqrt(m); usual: 10 to
    200; accepted: 0.1 to 1000; default: 60.0; only with law = "forman"."""
    nasgro_c: Number | None = None
    """Coefficient C of C [(1-f)/(1-R) dKeq]^n (1 - dKth/dKeq)^p / (1 - Kmax/Kc)^q. In mm/cycle, MPa
    sqrt(m); accepted: 1e-30 to 1; default: 1e-09; only with law = "nasgro"."""
    nasgro_n: Number | None = None
    """Exponent n. Usual: 1.5 to 7; accepted: 0.1 to 20; default: 3.0; only with law = "nasgro"."""
    nasgro_p: Number | None = None
    """Exponent p. Accepted: 0 to 10; default: 0.5; only with law = "nasgro"."""
    nasgro_q: Number | None = None
    """Exponent q. Accepted: 0 to 10; default: 0.5; only with law = "nasgro"."""
    nasgro_threshold: Number | None = None
    """dKth. In MPa sqrt(m); usual: 0.5 to 20; accepted: 0 to 1000; default: 5.0; only with law =
    "nasgro"."""
    nasgro_kc: Number | None = None
    """Kc, at which the crack runs away: the run ends with fracture. In MPa sqrt(m); usual: 10 to
    200; accepted: 0.1 to 1000; default: 40.0; only with law = "nasgro"."""
    nasgro_alpha: Number | None = None
    """Constraint alpha of Newman's f: 1 in plane stress, 3 in plane strain. Accepted: 1 to 3;
    default: 2.5; only with law = "nasgro"."""
    nasgro_s: Number | None = None
    """Largest stress over flow stress in Newman's f. Accepted: 0 to 0.99; default: 0.3; only with
    law = "nasgro"."""
    threshold_2_mpa_sqrt_m: Number | None = None
    """Threshold of dKII, in space of all shear; 0: none. With a threshold dKth of the law, a crack
    grows where (dKI/dKth)^2 + (dKII/threshold_2)^2 > 1; without, dKII counts only above it. Not
    with bold. In MPa sqrt(m); usual: 0.5 to 20; accepted: 0 to 1000; default: 0.0."""
    table_profile: File | None = None
    """CSV file with the columns delta_keq_mpa_sqrt_m,rate_mm_per_cycle; linear in log-log scale, no
    growth below the first row. Only with law = "table"."""
    steel: Literal["R260", "R350HT", "R260-typical", "R350HT-typical", "U71Mn"] | None = None
    """Rail steel with its growth law, instead of law and its constants (docs/parameters.md).
    "R260": the limit of EN 13674-1, not the growth of a rail; "R350HT": the same limit;
    "R260-typical": typical, a fifth of the limit; "R350HT-typical": the same, with more scatter;
    "U71Mn": 2.56e-9 dKeq^3.18, as measured at R = 0.1."""
    arrest_rate_mm_per_cycle: Number | None = None
    """Rate below which a tip is arrested. In mm/cycle; accepted: 0 to 1; default: 1e-09."""
    direction: Literal["max-rate", "max-rate-unclipped", "max-delta-k1", "max-k1", "coplanar", "mts", "max-delta-ctd"] | None = None
    """Criterion of the growth direction. Default: "max-rate". "max-rate": the largest growth rate
    of the kink (Hourlier-Pineau); "max-rate-unclipped": the same, with negative k1 kept where
    max-rate takes zero; "max-delta-k1": the largest range of k1; "max-k1": the largest k1;
    "coplanar": straight ahead; "mts": the largest tangential stress ahead of the tip;
    "max-delta-ctd": the largest range of the displacement vector at the tip of the kink."""
    critical_length_mm: Number | None = None
    """Crack length at which the run ends. In mm; usual: 0.2 to 250; accepted: 0.001 to 1e5."""
    stop_after_cycles: Number | None = None
    """Load cycles after which the run ends. In cycles; accepted: 0.001 to 1e18."""


class GrowthKeys(TypedDict, total=False):
    """Keys of `growth`, those of `Growth`."""

    steps: Count | None
    increment: Number | None
    tolerance: Number | None
    turning: Literal["smooth", "kink"] | None
    turning_length_mm: Number | None
    straight_to_mm: Number | None
    kink_angle_deg: Number | None
    kink_friction: Number | None
    law: Literal["paris", "paris-threshold", "bold", "walker", "forman", "nasgro", "table"] | None
    equivalent: Literal["hourlier-pineau", "tanaka", "richard"] | None
    paris_c: Number | None
    paris_m: Number | None
    mode_2_weight: Number | None
    mode_3_weight: Number | None
    front: Literal["ellipse", "free"] | None
    surface: Literal["plane", "turned"] | None
    front_harmonics: Count | None
    threshold_mpa_sqrt_m: Number | None
    bold_c: Number | None
    walker_c: Number | None
    walker_m: Number | None
    walker_gamma: Number | None
    forman_c: Number | None
    forman_m: Number | None
    forman_kc: Number | None
    nasgro_c: Number | None
    nasgro_n: Number | None
    nasgro_p: Number | None
    nasgro_q: Number | None
    nasgro_threshold: Number | None
    nasgro_kc: Number | None
    nasgro_alpha: Number | None
    nasgro_s: Number | None
    threshold_2_mpa_sqrt_m: Number | None
    table_profile: File | None
    steel: Literal["R260", "R350HT", "R260-typical", "R350HT-typical", "U71Mn"] | None
    arrest_rate_mm_per_cycle: Number | None
    direction: Literal["max-rate", "max-rate-unclipped", "max-delta-k1", "max-k1", "coplanar", "mts", "max-delta-ctd"] | None
    critical_length_mm: Number | None
    stop_after_cycles: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Fracture(Section):
    """Brittle fracture: the run ends when the largest k1 of a passage over all kink angles reaches
    the toughness, unless the kink arrests."""

    _section: ClassVar[str] = "fracture"
    toughness_mpa_sqrt_m: Number | None = None
    """Fracture toughness K_Ic. In MPa sqrt(m); usual: 10 to 200; accepted: 0.1 to 1000."""
    steel: Literal["R260", "R350HT"] | None = None
    """Rail steel, with its mean toughness by EN 13674-1 at -20 degrees C. "R260": 29 MPa sqrt(m);
    "R350HT": 32 MPa sqrt(m)."""
    profile: File | None = None
    """CSV file with the columns temperature_c,toughness_mpa_sqrt_m; linear between rows. Requires
    [temperature]."""
    criterion: Literal["arrest", "k1"] | None = None
    """When a k1 that reaches the toughness breaks the rail. Default: "arrest". "arrest": if k1 at
    the tip of a kink of pop_in_mm reaches it as well; "k1": at once; in space always."""
    pop_in_mm: Number | None = None
    """Length of the kink added at the largest k1, a pop-in after which growth goes on if k1 at its
    tip is below the toughness. In mm; usual: 0.05 to 20; accepted: 0.01 to 100; default: 2.0; only
    with criterion = "arrest"."""


class FractureKeys(TypedDict, total=False):
    """Keys of `fracture`, those of `Fracture`."""

    toughness_mpa_sqrt_m: Number | None
    steel: Literal["R260", "R350HT"] | None
    profile: File | None
    criterion: Literal["arrest", "k1"] | None
    pop_in_mm: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Mesh(Section):
    """Discretisation."""

    _section: ClassVar[str] = "mesh"
    element_size_mm: Number | None = None
    """Element size at the cracks with finite elements; by default a thirtieth to a 75th of the
    longest crack, less at short cracks and segments. In mm; accepted: above 0 to 100."""
    tip_enrichment_radius_mm: Number | None = None
    """Radius of the square-root enrichment around a tip; by default two and a half elements. In mm;
    accepted: above 0 to 100."""
    interface_spacing_mm: Number | None = None
    """Largest distance between face points with finite elements, at least 0.3 of the element size;
    by default the crack length within an element. In mm; accepted: above 0 to 100."""
    interface_elements: Count | None = None
    """Elements along each crack with dislocations; by default 28, with more than four cracks 132
    shared by all, at least 22 each. Accepted: 8 to 400."""
    space_cells: Count | None = None
    """Cells from the centre of a crack to each side of its inner block in space; by default 4.
    Shallow cracks need 6. Accepted: 2 to 16."""
    space_rings: Count | None = None
    """Cells from the inner block to the front in space; by default 4. Accepted: 2 to 16."""
    space_surface_rows: Count | None = None
    """Rows of cells added at the surface in space, by default 0. Each halves the 15 degrees of
    front at the surface where K does not count in growth. Planar surface-breaking cracks only.
    Accepted: 0 to 6."""


class MeshKeys(TypedDict, total=False):
    """Keys of `mesh`, those of `Mesh`."""

    element_size_mm: Number | None
    tip_enrichment_radius_mm: Number | None
    interface_spacing_mm: Number | None
    interface_elements: Count | None
    space_cells: Count | None
    space_rings: Count | None
    space_surface_rows: Count | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Solver(Section):
    """Engine and solvers."""

    _section: ClassVar[str] = "solver"
    engine: Literal["xfem", "dislocation", "space"] | None = None
    """Engine of the cracked rail. Default: "xfem". "xfem": extended finite elements; "dislocation":
    distributed dislocations in a half-plane; "space": cracks with curved fronts in a half-space."""
    contact: Literal["newton", "latin"] | None = None
    """Solver of the contact conditions on the crack faces. Default: "newton". "newton": active
    sets, exact complementarity; "latin": the LATIN method of the paper."""
    network: Literal["whole", "groups"] | None = None
    """Solution of the contact conditions of many cracks. By default groups from 24 cracks on where
    possible, with dislocations in a half-plane, otherwise whole. "whole": all cracks together; the
    cost grows with the square of their number; "groups": each crack with its neighbours, in sweeps
    until they agree within network_tolerance; for dozens of cracks, with the dislocation or the
    space engine and the newton solver, without trapped fluid and without fields."""


class SolverKeys(TypedDict, total=False):
    """Keys of `solver`, those of `Solver`."""

    engine: Literal["xfem", "dislocation", "space"] | None
    contact: Literal["newton", "latin"] | None
    network: Literal["whole", "groups"] | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Traffic(Section):
    """Traffic, for results in million gross tonnes (MGT)."""

    _section: ClassVar[str] = "traffic"
    axle_load_t: Number | None = None
    """Axle load. Required, unless every [[wheel]] has its own. In t; usual: 3 to 45; accepted:
    0.001 to 100."""
    mgt_per_year: Number | None = None
    """Traffic of a year; results are then also in months. In MGT; usual: 0.01 to 400; accepted:
    1e-6 to 10000."""


class TrafficKeys(TypedDict, total=False):
    """Keys of `traffic`, those of `Traffic`."""

    axle_load_t: Number | None
    mgt_per_year: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Maintenance(Section):
    """Wear and grinding, which shorten cracks from their mouths; requires axle loads."""

    _section: ClassVar[str] = "maintenance"
    wear_mm_per_mgt: Number | None = None
    """Wear depth per million gross tonnes. In mm/MGT; usual: 1e-5 to 0.3; accepted: 0 to 100;
    default: 0.0."""
    grinding_mm: Number | None = None
    """Depth removed by each grinding; requires grinding_interval_mgt. In mm; usual: 0.01 to 5;
    accepted: 1e-6 to 100."""
    grinding_interval_mgt: Number | None = None
    """Traffic from one grinding to the next. In MGT; usual: 0.001 to 500; accepted: 1e-6 to 1e6."""
    first_grinding_mgt: Number | None = None
    """Traffic until the first grinding; by default grinding_interval_mgt. In MGT; usual: 0.001 to
    500; accepted: 0 to 1e6."""
    wear_limit_mm: Number | None = None
    """Total removed depth at which the rail is replaced and the run ends. In mm; usual: 0.5 to 40;
    accepted: 0.001 to 100."""
    least_spall_mm: Number | None = None
    """Thickness from which a spall is a failure; by default the larger of 0.3 and grinding_mm,
    without flakes cut off by grinding. In mm; usual: 0.01 to 20; accepted: 0 to 100."""
    stress_moves_with: Literal["metal", "surface"] | None = None
    """How residual and plastic stresses move as the surface wears. Default: "metal". "metal": the
    stress stays in place in the steel; "surface": the stress keeps its depth below the surface."""


class MaintenanceKeys(TypedDict, total=False):
    """Keys of `maintenance`, those of `Maintenance`."""

    wear_mm_per_mgt: Number | None
    grinding_mm: Number | None
    grinding_interval_mgt: Number | None
    first_grinding_mgt: Number | None
    wear_limit_mm: Number | None
    least_spall_mm: Number | None
    stress_moves_with: Literal["metal", "surface"] | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Inspection(Section):
    """Inspection interval: the traffic from a detectable to a critical crack over safety_factor;
    requires axle loads."""

    _section: ClassVar[str] = "inspection"
    detectable_depth_mm: Number | None = None
    """Tip depth from which a crack is detectable. In mm; usual: 0.05 to 150; accepted: 0 to 1000."""
    detectable_length_mm: Number | None = None
    """Length from which a crack is detectable. In mm; usual: 0.05 to 150; accepted: 0 to 1000."""
    critical_depth_mm: Number | None = None
    """Critical tip depth; critical_length_mm of [growth] and fracture are critical too. In mm;
    usual: 0.2 to 250; accepted: 0.001 to 1000."""
    ultrasonic_depth_mm: Number | None = None
    """Tip depth from which ultrasonic testing finds a crack that has turned down. In mm; usual: 0.2
    to 250; accepted: 0.001 to 1000; default: 5.0."""
    safety_factor: Number | None = None
    """Divisor of the traffic from detectable to critical. Usual: 1 to 20; accepted: 1 to 100;
    default: 3.0."""
    target_risk: Number | None = None
    """Accepted probability of failure before detection; the largest interval that keeps it is
    computed. Accepted: 1e-9 to 1."""
    pod: File | None = None
    """CSV file with the columns depth_mm,probability (of detection); linear between rows, zero for
    smaller depths, constant for larger ones. Not with pod_median_mm; without either, every
    detectable crack is found."""
    pod_median_mm: Number | None = None
    """Depth at which half of the cracks are found; the probability of detection is
    Phi(ln(depth/median)/pod_log_std). In mm; usual: 0.05 to 150; accepted: 0.001 to 1000."""
    pod_log_std: Number | None = None
    """Logarithmic standard deviation of the depth of detection; requires pod_median_mm. Accepted:
    0.001 to 10."""


class InspectionKeys(TypedDict, total=False):
    """Keys of `inspection`, those of `Inspection`."""

    detectable_depth_mm: Number | None
    detectable_length_mm: Number | None
    critical_depth_mm: Number | None
    ultrasonic_depth_mm: Number | None
    safety_factor: Number | None
    target_risk: Number | None
    pod: File | None
    pod_median_mm: Number | None
    pod_log_std: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Scatter(Section):
    """Scatter of quantities that do not change the path, sampled after the run; requires axle
    loads."""

    _section: ClassVar[str] = "scatter"
    samples: Count | None = None
    """Number of samples. Accepted: 10 to 1e7; default: 100000."""
    seed: Count | None = None
    """Seed of the random numbers. Accepted: 0 to 4.29497e9; default: 1."""
    paris_c_log_std: Number | None = None
    """Standard deviation of ln C of the growth law; by default prior_log_std of [calibration], in a
    calibrated case that of the steel of [growth], or 0.3. Accepted: 0 to 5."""
    paris_m_std: Number | None = None
    """Standard deviation of the exponent, with the rate at dKeq = 10 MPa sqrt(m) kept. Accepted: 0
    to 5; default: 0.0."""
    toughness_std: Number | None = None
    """Standard deviation of the toughness of [fracture]. In MPa sqrt(m); accepted: 0 to 100;
    default: 0.0."""
    detectable_depth_std: Number | None = None
    """Standard deviation of the detectable depth. In mm; accepted: 0 to 100; default: 0.0."""
    wear_std: Number | None = None
    """Standard deviation of wear_mm_per_mgt; negative samples count as zero. In mm/MGT; accepted: 0
    to 100; default: 0.0."""
    share_log_std: Number | None = None
    """Standard deviation of ln of the share of each [[wheel]], before normalisation. Accepted: 0 to
    5; default: 0.0."""


class ScatterKeys(TypedDict, total=False):
    """Keys of `scatter`, those of `Scatter`."""

    samples: Count | None
    seed: Count | None
    paris_c_log_std: Number | None
    paris_m_std: Number | None
    toughness_std: Number | None
    detectable_depth_std: Number | None
    wear_std: Number | None
    share_log_std: Number | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Calibration(Section):
    """Prior of the coefficient C of the growth law for `railcrack calibrate`."""

    _section: ClassVar[str] = "calibration"
    prior_log_mean: Number | Literal["suite"] | None = None
    """Prior mean of ln C, relative to the case; "suite" takes that of the residuals of `railcrack
    validate`: -0.02 in the plane, 0.26 in space. Accepted: -20 to 20; default: "suite"."""
    prior_log_std: Number | Literal["suite"] | None = None
    """Prior standard deviation of ln C; "suite" likewise takes 1.27 in the plane, 1.28 in space.
    Accepted: above 0 to 10; default: "suite"."""
    discrepancy_log_std: Number | Literal["evidence"] | None = None
    """Standard deviation of ln C from site to site; "evidence" takes the value that makes the
    measurements most probable. Accepted: 0 to 10; default: "evidence"."""
    least_depth_mm: Number | None = None
    """Least measured depth (or length), written by `railcrack calibrate`. In mm; accepted: 0 to
    1000."""
    greatest_depth_mm: Number | None = None
    """Greatest measured depth (or length), beyond which a decision says that nothing was measured.
    In mm; accepted: 0 to 1000."""
    sites: Count | None = None
    """Number of measured sites, written by `railcrack calibrate`; without it, a decision says that
    absolute rates are not known. Accepted: 1 to 1e5."""


class CalibrationKeys(TypedDict, total=False):
    """Keys of `calibration`, those of `Calibration`."""

    prior_log_mean: Number | Literal["suite"] | None
    prior_log_std: Number | Literal["suite"] | None
    discrepancy_log_std: Number | Literal["evidence"] | None
    least_depth_mm: Number | None
    greatest_depth_mm: Number | None
    sites: Count | None


@dataclass(frozen=True, repr=False, kw_only=True)
class Output(Section):
    """Output of a run. Defaults in a study are `faces = "none"`, `sif = "ends"` and no fields,
    plots or pages; `railcrack report` makes plots and pages later."""

    _section: ClassVar[str] = "output"
    fields_over_a: Numbers | None = None
    """Wheel positions, from the mouth of the first crack, of written fields of displacement and
    stress; finite elements only. In a; accepted: -1000 to 1000; default: [-1.0, 0.0, 1.0]."""
    fields_every: Count | None = None
    """Growth steps between fields, from step 0 on; 0 writes none. Accepted: 0 to 10000; default:
    25."""
    fields: bool | None = None
    """Whether fields are written. Default: True."""
    faces: Literal["all", "ends", "none", True, False] | None = None
    """Growth steps written to `faces.csv`. Default: "all". "all": every step; "ends": the first and
    the last; "none": no such table; True: every step; False: no such table."""
    sif: Literal["all", "ends", "none", True, False] | None = None
    """Growth steps written to `sif.csv`. Default: "all". "all": every step; "ends": the first and
    the last; "none": no such table; True: every step; False: no such table."""
    plots: bool | None = None
    """Whether plots are drawn. Default: True."""
    report: bool | None = None
    """Whether the page `report.html` is written. Default: True."""
    explorer: bool | None = None
    """Whether the page can recompute the case with other values, at 2 MB more. Dislocations only,
    in cases without files; needs the engine of pages. Default: False."""
    run_folders: bool | None = None
    """In a study, whether each run has its own folder; otherwise all runs share a few files.
    Default: True."""


class OutputKeys(TypedDict, total=False):
    """Keys of `output`, those of `Output`."""

    fields_over_a: Numbers | None
    fields_every: Count | None
    fields: bool | None
    faces: Literal["all", "ends", "none", True, False] | None
    sif: Literal["all", "ends", "none", True, False] | None
    plots: bool | None
    report: bool | None
    explorer: bool | None
    run_folders: bool | None


class Sections(TypedDict, total=False):
    """The sections of a case."""

    title: str
    rail: Rail | RailKeys
    contact: Contact | Hertz | Carter | ContactTable | Rolling | ContactKeys
    track: Track | TrackKeys
    temperature: Temperature | TemperatureKeys
    wheel: Sequence[Wheel | WheelKeys]
    wheels: Sequence[Wheel | WheelKeys]
    passage: PassageSettings | PassageSettingsKeys
    crack: Sequence[Crack | CrackKeys]
    cracks: Sequence[Crack | CrackKeys]
    residual_stress: ResidualStress | ResidualStressKeys
    plastic_stress: PlasticStress | PlasticStressKeys
    fluid: Fluid | FluidKeys
    shakedown: ShakedownSettings | ShakedownSettingsKeys
    growth: Growth | GrowthKeys
    fracture: Fracture | FractureKeys
    mesh: Mesh | MeshKeys
    solver: Solver | SolverKeys
    traffic: Traffic | TrafficKeys
    maintenance: Maintenance | MaintenanceKeys
    inspection: Inspection | InspectionKeys
    scatter: Scatter | ScatterKeys
    calibration: Calibration | CalibrationKeys
    output: Output | OutputKeys


class Changes(TypedDict, total=False):
    """Changes of a case: None removes a key or a section."""

    title: str | None
    rail: Rail | RailKeys | None
    contact: Contact | Hertz | Carter | ContactTable | Rolling | ContactKeys | None
    track: Track | TrackKeys | None
    temperature: Temperature | TemperatureKeys | None
    wheel: WheelKeys | Sequence[Wheel | WheelKeys] | None
    wheels: WheelKeys | Sequence[Wheel | WheelKeys] | None
    passage: PassageSettings | PassageSettingsKeys | None
    crack: CrackKeys | Sequence[Crack | CrackKeys] | None
    cracks: CrackKeys | Sequence[Crack | CrackKeys] | None
    residual_stress: ResidualStress | ResidualStressKeys | None
    plastic_stress: PlasticStress | PlasticStressKeys | None
    fluid: Fluid | FluidKeys | None
    shakedown: ShakedownSettings | ShakedownSettingsKeys | None
    growth: Growth | GrowthKeys | None
    fracture: Fracture | FractureKeys | None
    mesh: Mesh | MeshKeys | None
    solver: Solver | SolverKeys | None
    traffic: Traffic | TrafficKeys | None
    maintenance: Maintenance | MaintenanceKeys | None
    inspection: Inspection | InspectionKeys | None
    scatter: Scatter | ScatterKeys | None
    calibration: Calibration | CalibrationKeys | None
    output: Output | OutputKeys | None


__all__ = [
    "Calibration",
    "Carter",
    "Contact",
    "ContactTable",
    "Crack",
    "Fluid",
    "Fracture",
    "Growth",
    "Hertz",
    "Inspection",
    "Maintenance",
    "Mesh",
    "Output",
    "PassageSettings",
    "PlasticStress",
    "Rail",
    "ResidualStress",
    "Rolling",
    "Scatter",
    "ShakedownSettings",
    "Solver",
    "Temperature",
    "Track",
    "Traffic",
    "Wheel",
]
