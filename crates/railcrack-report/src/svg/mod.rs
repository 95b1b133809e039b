//! Drawing: SVG elements, axes with round ticks, legends, colours. Knows nothing of cracks.

mod axes;
mod element;
mod legend;
mod palette;
mod ticks;
mod words;

pub(crate) use axes::{Axes, Axis, Frame, around, ends};
pub(crate) use element::{Anchor, Span, Stroke, Svg, TextStyle, coordinate};
pub(crate) use legend::{Entry, Mark, draw_legend, legend_width};
pub(crate) use palette::{AREA, BLUE, CATEGORIES, GREY, INK, LIGHT, ORANGE, RAIL, ZERO, sequence};
pub(crate) use ticks::{decimals_of, round_step};
pub(crate) use words::{quantity, text};
