//! Conversion of plots from SVG to PNG.

use railcrack_run::disk::{Durability, inner_folder, replace_file};
use railcrack_run::simulation::RunError;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::path::{Path, PathBuf};

/// Pixels per unit of a plot: 200 dpi where a unit is a point at 100 %.
const SCALE: f32 = 2.8;

/// Fonts of the plots, embedded so that PNG files are the same on every machine.
const FONTS: [&[u8]; 3] = [
    include_bytes!("../fonts/LiberationSans-Regular.ttf"),
    include_bytes!("../fonts/LiberationSans-Bold.ttf"),
    include_bytes!("../fonts/LiberationSans-Italic.ttf"),
];

/// Writes a PNG file for every SVG file in `folder` and its subfolders `plots` and `figures`, into
/// the same directory. Returns the number of files.
///
/// Errors: a plot is not an SVG file; the system refuses.
pub fn write_beside_plots(folder: &Path) -> Result<usize, RunError> {
    let mut options = Options::default();
    for font in FONTS {
        options.fontdb_mut().load_font_data(font.to_vec());
    }
    let plots = plots(folder)?;
    for plot in &plots {
        let svg = std::fs::read_to_string(plot).map_err(refused("read", plot))?;
        let png = drawn(&svg, &options)
            .map_err(|reason| RunError::System { action: format!("draw {}", plot.display()), reason })?;
        let target = plot.with_extension("png");
        replace_file(&target, &png, Durability::Cached)?;
    }
    Ok(plots.len())
}

/// The SVG files in alphabetical order.
fn plots(folder: &Path) -> Result<Vec<PathBuf>, RunError> {
    let mut plots = Vec::new();
    let mut places = vec![folder.to_path_buf()];
    for inner in ["plots", "figures"].into_iter().filter(|inner| folder.join(inner).is_dir()) {
        places.push(inner_folder(folder, inner)?);
    }
    for place in places {
        for entry in std::fs::read_dir(&place).map_err(refused("read", &place))? {
            let path = entry.map_err(refused("read", &place))?.path();
            if path.extension().is_some_and(|ending| ending == "svg") {
                plots.push(path);
            }
        }
    }
    plots.sort();
    Ok(plots)
}

fn drawn(svg: &str, options: &Options) -> Result<Vec<u8>, String> {
    let tree = Tree::from_str(svg, options).map_err(|reason| reason.to_string())?;
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|length| (SCALE * length).ceil() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| format!("{width} x {height} pixels"))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|reason| reason.to_string())
}

fn refused(action: &str, path: &Path) -> impl FnOnce(std::io::Error) -> RunError {
    let action = format!("{action} {}", path.display());
    move |reason| RunError::System { action, reason: reason.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::tiny_skia::Color;

    fn options() -> Options<'static> {
        let mut options = Options::default();
        FONTS.into_iter().for_each(|font| options.fontdb_mut().load_font_data(font.to_vec()));
        options
    }

    fn pixels(content: &str) -> Pixmap {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"40\" font-family=\"Helvetica, 'Liberation Sans'\">\
             <rect width=\"100\" height=\"40\" fill=\"#ffffff\"/>{content}</svg>"
        );
        Pixmap::decode_png(&drawn(&svg, &options()).unwrap()).unwrap()
    }

    fn dark(pixels: &Pixmap) -> usize {
        pixels.pixels().iter().filter(|pixel| pixel.demultiply().red() < 128).count()
    }

    #[test]
    fn shapes_are_where_they_are_drawn() {
        let drawn = pixels("<rect x=\"50\" width=\"50\" height=\"40\" fill=\"#ff0000\"/>");
        assert_eq!((drawn.width(), drawn.height()), (280, 112));
        let at = |x: u32| {
            let pixel = drawn.pixel(x, 56).unwrap().demultiply();
            Color::from_rgba8(pixel.red(), pixel.green(), pixel.blue(), pixel.alpha())
        };
        assert_eq!((at(100), at(200)), (Color::WHITE, Color::from_rgba8(255, 0, 0, 255)));
    }

    #[test]
    fn letters_of_plots_are_in_the_fonts() {
        let text = |letters: &str, style: &str| {
            dark(&pixels(&format!("<text x=\"5\" y=\"30\" font-size=\"20\" {style}>{letters}</text>")))
        };
        let nothing = text("", "");
        for letter in ["K", "Δ", "σ", "μ", "√", "−", "×", "·", "°", "²", "→", "ł"] {
            assert!(text(letter, "") > nothing + 5, "{letter}");
        }
        assert!(text("K", "font-weight=\"bold\"") > text("K", ""));
        assert!(text("K", "font-style=\"italic\"") > nothing);
    }

    #[test]
    fn what_is_no_picture_is_an_error() {
        assert!(drawn("K_I", &options()).is_err());
    }
}
