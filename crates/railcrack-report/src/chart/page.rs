//! A chart on a page: its data, which the page's script draws with values under the pointer.

use super::axis::{ChartAxis, ChartRange, ChartScale};
use super::curve::{Curve, CurveColour, CurveWidth};
use super::types::{Chart, ChartAspect, ChartLegend};
use crate::html::{escaped, json_for_script, typeset};
use crate::numbers::numbers;
use serde_json::{Value, json};
use std::fmt::Write;

impl Chart {
    /// Appends the chart to `page`.
    pub(crate) fn write(&self, page: &mut String) {
        let (id, caption) = (escaped(&self.id), typeset(&self.caption));
        let data = json_for_script(&self.data());
        // Writing to a string does not fail.
        let _ = writeln!(
            page,
            "<figure class=\"chart\" id=\"{id}\" data-name=\"{id}\">\n<div class=\"drawing\"></div>\n\
             <script type=\"application/json\">{data}</script>\n<figcaption>{caption}</figcaption>\n</figure>"
        );
    }

    fn data(&self) -> Value {
        let places = |points: &[[f64; 2]], c: usize| numbers(points.iter().map(|point| point[c]));
        let mut data = json!({
            "x": axis(&self.x),
            "y": axis(&self.y),
            "equal": self.aspect == ChartAspect::Equal,
            "legend": self.legend == ChartLegend::Names,
            "caption": self.caption,
            "curves": self.curves.iter().enumerate().map(curve).collect::<Vec<_>>(),
        });
        if !self.areas.is_empty() {
            let area = self.areas.iter().map(|area| {
                json!({ "name": area.name, "x": places(&area.outline, 0), "y": places(&area.outline, 1) })
            });
            data["areas"] = area.collect();
        }
        if !self.notes.is_empty() {
            let note = self.notes.iter().map(|note| json!({ "at": numbers(note.at), "words": note.words }));
            data["notes"] = note.collect();
        }
        data
    }
}

fn axis(axis: &ChartAxis) -> Value {
    json!({
        "title": axis.title(),
        "scale": match axis.scale {
            ChartScale::Linear => "linear",
            ChartScale::Logarithmic => "log",
            ChartScale::Depth => "depth",
        },
        "zero": axis.range == ChartRange::AroundZero,
        "range": match axis.range {
            ChartRange::Exact(ends) => Some(numbers(ends)),
            _ => None,
        },
    })
}

fn curve((place, curve): (usize, &Curve)) -> Value {
    let dots: Vec<usize> = (0..curve.points.len()).filter(|&i| curve.has_dot(i)).collect();
    json!({
        "name": curve.name,
        "note": curve.note,
        "look": curve.look.name(),
        "dots": if dots.len() == curve.points.len() { json!(!dots.is_empty()) } else { json!(dots) },
        "colour": curve.colour.unwrap_or(CurveColour::Category(place)).name(),
        "wide": curve.width == CurveWidth::Wide,
        "fine": curve.width == CurveWidth::Fine,
        "choices": curve.choices,
        "x": numbers(curve.points.iter().map(|point| point[0])),
        "y": numbers(curve.points.iter().map(|point| point[1])),
    })
}
