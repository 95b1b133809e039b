//! Fig. 21: the stress by depth that the paper describes, its two readings, and what rolling alone leaves.

use super::steel::Steel;
use railcrack::field::{DepthProfile, StressField};
use railcrack::math::Vec2;
use railcrack::shakedown::{RailState, StabilisedRail};
use railcrack_report::svg::{
    Anchor, Axes, Axis, CATEGORIES, Entry, Frame, INK, Mark, Span, Stroke, Svg, TextStyle, draw_legend,
    legend_width,
};

/// Depths of the table and the picture, mm.
const DEEPEST: f64 = 16.0;
const SPACING: f64 = 0.1;

/// A line of Fig. 21.
pub(super) struct StressProfile {
    pub name: String,
    /// σ_xx at every multiple of [`SPACING`] down to [`DEEPEST`], MPa.
    pub sxx: Vec<f64>,
    /// Depth, mm, and plastic shear ε_p,xy of every layer, where it was computed.
    pub plastic_shear: Vec<[f64; 2]>,
    /// The state that repeated passages lead to, where it was computed.
    pub state: Option<RailState>,
}

impl StressProfile {
    /// Depth (mm) and value (MPa) of the largest |σ_xx|.
    pub(super) fn extreme(&self) -> (f64, f64) {
        let largest = |best: (f64, f64), (i, s): (usize, &f64)| {
            if s.abs() > best.1.abs() { (i as f64 * SPACING, *s) } else { best }
        };
        self.sxx.iter().enumerate().fold((0.0, 0.0), largest)
    }
}

fn depths() -> impl Iterator<Item = f64> {
    (0..=(DEEPEST / SPACING).round() as usize).map(|i| i as f64 * SPACING)
}

/// The lines: the table `given` in both readings, then the residual stress that `rolled` rails keep. A plastic stress along the rail
/// that depends on depth alone leaves its opposite in a half-plane.
pub(super) fn profiles(given: &DepthProfile, rolled: &[(Steel, StabilisedRail)]) -> Vec<StressProfile> {
    let readings =
        [("read as balanced stress", 1.0), ("read as plastic stress, balanced in a half-plane", -1.0)];
    let reading = |(name, factor): (&str, f64)| StressProfile {
        name: name.into(),
        sxx: depths().map(|depth| factor * given.stress(Vec2::new(0.0, -depth)).xx).collect(),
        plastic_shear: Vec::new(),
        state: None,
    };
    let kept = |(steel, rail): &(Steel, StabilisedRail)| StressProfile {
        name: steel.words(),
        sxx: depths().map(|depth| rail.residual_stress(depth).xx).collect(),
        plastic_shear: rail.profile.iter().map(|layer| [layer.depth, layer.strain.xy]).collect(),
        state: Some(rail.state),
    };
    readings.map(reading).into_iter().chain(rolled.iter().map(kept)).collect()
}

/// The picture of Fig. 21.
pub(super) fn draw(lines: &[StressProfile]) -> String {
    let stroke = |i: usize| Stroke {
        dashes: if i < 2 { "" } else { "5 3" },
        ..Stroke::solid(CATEGORIES[i % CATEGORIES.len()], if i < 2 { 2.2 } else { 1.5 })
    };
    let entries: Vec<Entry> = lines
        .iter()
        .enumerate()
        .map(|(i, line)| Entry { mark: Mark::Line(stroke(i)), words: line.name.clone() })
        .collect();
    let frame = Frame { left: 76.0, top: 58.0, width: 560.0, height: 340.0 };
    let mut svg = Svg::new(frame.right() + 24.0 + legend_width(&entries), frame.bottom() + 56.0);
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    svg.text(
        [frame.left, 24.0],
        &[Span::plain("Trollé et al. (2014), Fig. 21 in words, and rolled rails")],
        bold,
    );
    let axes = Axes {
        frame,
        x: Axis::exact(0.0, DEEPEST, 9),
        y: Axis::around(lines.iter().flat_map(|line| line.sxx.iter().copied()), 8),
    };
    axes.draw_grid(&mut svg);
    axes.clip(&mut svg);
    for (i, line) in lines.iter().enumerate() {
        let points: Vec<[f64; 2]> = depths().zip(&line.sxx).map(|(depth, &s)| axes.at(depth, s)).collect();
        svg.polyline("series", &points, &stroke(i));
    }
    svg.unclip();
    let stress = [Span::Italic("\u{3c3}"), Span::Sub("xx"), Span::plain("  (MPa)")];
    axes.draw_frame(&mut svg, &[Span::plain("Depth  (mm)")], &stress);
    draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
    svg.finish("Fig. 21: stress by depth")
}

/// The columns of the table of Fig. 21.
pub const PROFILE_FIGURE_COLUMNS: &str = "profile,depth_mm,sxx_mpa";

/// The table of Fig. 21.
pub(super) fn table(lines: &[StressProfile]) -> String {
    let mut text = format!("{PROFILE_FIGURE_COLUMNS}\n");
    for line in lines {
        for (depth, sxx) in depths().zip(&line.sxx) {
            text.push_str(&format!("\"{}\",{depth:.1},{sxx:?}\n", line.name));
        }
    }
    text
}
