//! Drawing: SVG elements, axes with round ticks, legends, colours. Knows nothing of cracks.

mod axes;
mod legend;
mod palette;
mod svg;
mod ticks;

pub use axes::{Axes, Axis, Frame};
pub use legend::{Entry, Mark, draw_legend, legend_width};
pub use palette::{BLUE, CATEGORIES, GREY, INK, LIGHT, ORANGE, sequence};
pub use svg::{Anchor, Span, Stroke, Svg, TextStyle, coordinate};
pub use ticks::round_step;
