//! Drawing: SVG elements, axes with round ticks, legends, colours. Knows nothing of cracks.

mod axes;
mod element;
mod legend;
mod palette;

pub(crate) use axes::{Axes, Axis, Frame, around, decimals_of, ends, multiples, round_step};
pub(crate) use element::{Anchor, Span, Stroke, Svg, TextStyle, coordinate, quantity, text};
pub(crate) use legend::{Entry, Mark, draw_legend, legend_width};
pub(crate) use palette::{AREA, BLUE, CATEGORIES, GREY, INK, LIGHT, ORANGE, RAIL, ZERO, sequence};
