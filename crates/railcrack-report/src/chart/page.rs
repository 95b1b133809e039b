//! A chart on a page: the same picture in the colours of the page, with what its script must know
//! to say values under the pointer, to hide curves and to move others.

use super::sheet::{Ground, draw, scales, stroke};
use super::types::{Chart, ChartAspect, ChartLegend};
use super::types::{Curve, CurveColour, CurveDots, CurveLook};
use crate::html::{escaped, in_page_colours, typeset};
use crate::markup::plain;
use crate::svg::{Axes, Frame, Svg};
use std::fmt::Write;

/// Width of a chart on a page, and of a long one.
const WIDTH: f64 = 440.0;
const LONG: f64 = 960.0;
/// Height of its inside: of one that is not to scale, of a long one, and the most of one to scale.
const HEIGHT: f64 = 230.0;
const LONG_HEIGHT: f64 = 200.0;
const TO_SCALE: f64 = 300.0;
/// Room above, at the right and below its inside.
const ABOVE: f64 = 12.0;
const RIGHT: f64 = 19.0;
const BELOW: f64 = 48.0;

impl Chart {
    /// The chart as an element of a page.
    #[must_use]
    pub fn figure(&self) -> String {
        let mut page = String::new();
        self.write(&mut page);
        page
    }

    /// Appends the chart to `page`.
    pub(crate) fn write(&self, page: &mut String) {
        let (id, caption) = (escaped(&self.id), typeset(&self.caption));
        let legend = if self.legend == ChartLegend::Names { self.page_legend() } else { String::new() };
        let drawing = self.page_drawing();
        let mut class = "chart".to_owned();
        if self.aspect == ChartAspect::Long {
            class.push_str(" long");
        }
        if self.curves.iter().all(|curve| curve.points.is_empty()) {
            class.push_str(" blank");
        }
        // Writing to a string does not fail.
        let _ = writeln!(
            page,
            "<figure class=\"{class}\" id=\"{id}\"><div class=\"legends\">{legend}</div>\n\
             <div class=\"drawing\">{drawing}</div><figcaption>{caption}</figcaption></figure>"
        );
    }

    /// The picture; its axes stand in its attributes: values and pixels at both ends.
    fn page_drawing(&self) -> String {
        let is_long = self.aspect == ChartAspect::Long;
        let (width, height) = if is_long { (LONG, LONG_HEIGHT) } else { (WIDTH, HEIGHT) };
        let scales = |inside: f64| scales(self, &[self], [inside, height], TO_SCALE);
        // The labels of y say how much is left for the inside.
        let left = 34.0 + 7.0 * scales(width - 70.0).1.widest().max(2.0);
        let (x, y, height) = scales(width - left - RIGHT);
        let frame = Frame { left, top: ABOVE, width: width - left - RIGHT, height };
        let axes = Axes { frame, x, y };
        let mut svg = Svg::new(width, ABOVE + height + BELOW);
        draw(&mut svg, &axes, self, true, Ground::Page);
        let attributes = format!(
            r#"aria-label="{}" data-x="{}" data-y="{}" data-x-title="{}" data-y-title="{}""#,
            escaped(&plain(&self.caption)),
            axes.x.placed(frame.left, frame.right()),
            axes.y.placed(frame.bottom(), frame.top),
            escaped(&plain(&self.x.title())),
            escaped(&plain(&self.y.title()))
        );
        in_page_colours(&svg.finish_in_page(&attributes))
    }

    /// The names of the curves, each once, with their strokes; of areas with their ground.
    fn page_legend(&self) -> String {
        let mut known = Vec::new();
        let mut items = String::new();
        for area in &self.areas {
            if !known.contains(&area.name) {
                let mark = r#"<rect x="7" width="12" height="12" fill="var(--area)" stroke="var(--quiet)"/>"#;
                items.push_str(&legend_item(mark, &area.name));
                known.push(area.name.clone());
            }
        }
        for (place, curve) in self.curves.iter().enumerate() {
            let mark = curve_mark(place, curve);
            let key = format!("{}{mark}", curve.name);
            if !curve.name.is_empty() && !known.contains(&key) {
                items.push_str(&legend_item(&mark, &curve.name));
                known.push(key);
            }
        }
        if items.is_empty() { items } else { format!("<ul class=\"legend\">{items}</ul>") }
    }
}

fn legend_item(mark: &str, name: &str) -> String {
    let name = typeset(name);
    format!("<li><svg width=\"26\" height=\"12\" aria-hidden=\"true\">{mark}</svg><span>{name}</span></li>")
}

/// The mark of a curve in a legend.
fn curve_mark(place: usize, curve: &Curve) -> String {
    let colour = curve.colour.unwrap_or(CurveColour::Category(place));
    let stroke = stroke(curve.look, curve.width, colour, Ground::Page);
    let dot = format!(r#"<circle cx="13" cy="6" r="3" fill="{}"/>"#, stroke.colour);
    if curve.look == CurveLook::Dots {
        return dot;
    }
    let line = format!(
        r#"<line x2="26" y1="6" y2="6" stroke="{}" stroke-width="2" stroke-dasharray="{}"/>"#,
        stroke.colour, stroke.dashes
    );
    if curve.dots == CurveDots::All { line + &dot } else { line }
}
