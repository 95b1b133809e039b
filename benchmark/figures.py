"""Figures of the geometry: geometry.svg of every problem, from its problem.toml.

    python3 figures.py
"""

import math
import tomllib
from pathlib import Path

WIDTH, HEIGHT = 420, 210


def plane(whole):
    """Surface, contact and cracks of a part."""
    lines, notes = [], []
    for crack in whole["cracks"]:
        points = [(crack["mouth_x_mm"], 0.0)]
        for length, angle in crack["segments_mm_deg"]:
            (x, y), turn = points[-1], math.radians(angle)
            points.append((x + length * math.cos(turn), y - length * math.sin(turn)))
        lines.append(points)
    notes.append(", then ".join(f"{l:g} mm at {a:g}°" for l, a in whole["cracks"][0]["segments_mm_deg"]))
    left = min(-9.0, min(x for c in lines for x, _ in c) - 3)
    right = max(9.0, max(x for c in lines for x, _ in c) + 3)
    scale = min(WIDTH / (right - left), 20.0)
    at = lambda x, y: (f"{(x - left) * scale:.1f}", f"{80 - y * scale:.1f}")
    parts = [f'<rect x="0" y="80" width="{WIDTH}" height="{HEIGHT - 80}" fill="#eee"/><path d="M0,80H{WIDTH}" stroke="#333"/>']
    if "block_bottom" in whole:
        parts.append(f'<rect x="2" y="80" width="{WIDTH - 4}" height="122" fill="none" stroke="#333"/>')
        parts.append(f'<path d="M0,206H{WIDTH}" stroke="#333" stroke-width="6" stroke-dasharray="3,3"/>')
        notes.append(f"block of {whole['block_width_mm']:g} × {whole['block_depth_mm']:g} mm (not to scale), bottom {whole['block_bottom']}")
    if "tension_mpa" in whole:
        parts.append(arrow(60, 190, 20, 190) + arrow(WIDTH - 60, 190, WIDTH - 20, 190) + text(70, 194, "σ"))
    if "half_width_mm" in whole:
        a, centre = whole["half_width_mm"], -2.0
        x = [centre + a * math.cos(math.pi * i / 24) for i in range(25)]
        p = [1.5 * math.sin(math.pi * i / 24) for i in range(25)]
        parts.append(f'<polygon points="{" ".join(",".join(at(u, v)) for u, v in zip(x, p))}" fill="#cfe0ee" stroke="#1b6ca8"/>')
        cx, cy = (float(v) for v in at(centre, 0.0))
        parts.append(arrow(cx - 90, 58, cx - 40, 58) + text(cx - 90, 54, "travel") + text(cx - 6, 76, "x_c"))
        notes.append(f"a = {a:g} mm, p0 = {whole['peak_pressure_mpa']:g} MPa")
    for points in lines:
        parts.append(f'<polyline points="{" ".join(",".join(at(*p)) for p in points)}" fill="none" stroke="#c8432f" stroke-width="2"/>')
    ox = float(at(0.0, 0.0)[0])
    parts.append(arrow(ox, 80, ox + 30, 80) + arrow(ox, 80, ox, 50) + text(ox + 33, 92, "x") + text(ox - 10, 52, "y"))
    return parts, notes


def space(whole):
    """Section across the strike, and the crack in its plane."""
    crack = whole["cracks"][0]
    b, c, dip = crack["semi_axis_dip_mm"], crack["semi_axis_strike_mm"], math.radians(crack["dip_deg"])
    scale = 55.0 / max(b, c)
    parts = [f'<path d="M10,60H190" stroke="#333"/>', text(12, 54, "section")]
    buried = "centre_depth_mm" in crack
    start = -scale * b if buried else 0.0
    y0 = 130 if buried else 60
    at = lambda s: (100 + s * math.cos(dip), y0 + s * math.sin(dip))
    (x0, ya), (x1, yb) = at(start), at(scale * b)
    parts.append(f'<path d="M{x0:.1f},{ya:.1f}L{x1:.1f},{yb:.1f}" stroke="#c8432f" stroke-width="2"/>')
    parts.append(arrow(100, 60, 135, 60) + text(138, 56, "x"))
    parts.append(text(225, 54, "plane of the crack"))
    cy = 130 if buried else 75
    arc = (f'<ellipse cx="310" cy="{cy}" rx="{scale * c:.1f}" ry="{scale * b:.1f}" fill="#f3d9d4" stroke="#c8432f"/>' if buried else
           f'<path d="M{310 - scale * c:.1f},{cy}A{scale * c:.1f},{scale * b:.1f} 0 0 0 {310 + scale * c:.1f},{cy}Z" fill="#f3d9d4" stroke="#c8432f"/>')
    parts.append(arc + text(310 + scale * c + 4, cy + 4, "φ = 0") + text(316, cy + scale * b + 12, "90°"))
    return parts, [f"dip {crack['dip_deg']:g}°, semi-axes {b:g} mm down the dip, {c:g} mm along the strike"]


def arrow(x0, y0, x1, y1):
    """An arrow."""
    turn, head = math.atan2(y1 - y0, x1 - x0), []
    for side in (2.6, -2.6):
        head.append(f"{x1 + 6 * math.cos(turn + side):.1f},{y1 + 6 * math.sin(turn + side):.1f}")
    return f'<path d="M{x0},{y0}L{x1},{y1}M{head[0]}L{x1},{y1}L{head[1]}" fill="none" stroke="#333"/>'


def text(x, y, words):
    return f'<text x="{x:.0f}" y="{y:.0f}">{words}</text>'


def sites(data):
    """Readings of the sites with their errors."""
    parts, notes = [f'<path d="M210,30V190M20,190H400" stroke="#999"/>'], ["readings y with one standard deviation, a row for each site"]
    for i, site in enumerate(data["part"][-1]["sites"]):
        for j, (y, s) in enumerate(site):
            row = 50 + 45 * i + 9 * j
            x = lambda v: 210 + 110 * v
            parts.append(f'<path d="M{x(y - s):.0f},{row}H{x(y + s):.0f}" stroke="#1b6ca8"/><circle cx="{x(y):.0f}" cy="{row}" r="3" fill="#1b6ca8"/>')
    return [*parts, text(206, 204, "0"), text(316, 204, "1")], notes


def main():
    for path in sorted(Path(__file__).parent.glob("[0-9]*/problem.toml")):
        with open(path, "rb") as file:
            data = tomllib.load(file)
        whole = {**data.get("common", {}), **data["part"][0]}
        if "cracks" not in whole:
            whole["cracks"] = []
        if "sites" in whole:
            parts, notes = sites(data)
        elif whole["body"] == "half-space":
            parts, notes = space(whole)
        else:
            whole["cracks"] = whole["cracks"] or [{"mouth_x_mm": 0.0, "segments_mm_deg": []}]
            parts, notes = plane(whole)
        notes = [f"{path.parent.name}: {notes[0]}", "; ".join(notes[1:])] if notes[0] else [f"{path.parent.name}: {notes[-1]}"]
        caption = "".join(text(8, 14 + 13 * i, note) for i, note in enumerate(notes))
        (path.parent / "geometry.svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            f'font-family="sans-serif" font-size="10"><rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>{"".join(parts)}{caption}</svg>\n'
        )


if __name__ == "__main__":
    main()
