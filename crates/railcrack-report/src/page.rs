//! A page: the first screen, then sections of text, tables and charts, all in one file.

use crate::chart::Chart;
use crate::choices::Choices;
use crate::html::{escaped, inlined, json_for_script, typeset, typeset_in_parts};
use crate::table::Table;
use railcrack_run::VERSION;
use serde_json::Value;
use std::fmt::Write;

const STYLE: &str = include_str!("assets/page.css");
const COMMON: &str = include_str!("assets/common.js");
const CHOICES: &str = include_str!("assets/choices.js");

/// A key figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// Its name: "Load cycles".
    pub name: String,
    /// Its value with unit.
    pub value: String,
    /// A short note; empty for none.
    pub note: String,
}

/// A part of a section, in the order of reading. Texts are plain; `K_{I}` sets an index.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A heading below that of the section.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A list of sentences.
    List(Vec<String>),
    /// Warnings, a sentence each.
    Warnings(Vec<String>),
    /// A table.
    Table(Table),
    /// Lines to sign, which end a printed sheet.
    Approval(Table),
    /// A chart.
    Chart(Chart),
    /// Switches for curves and rows, once on a page.
    Choices(Choices),
    /// Parts side by side if there is space.
    Beside(Vec<Block>),
    /// A picture with its caption.
    Picture {
        /// The SVG file.
        svg: String,
        /// Its caption, a sentence.
        caption: String,
    },
    /// Preformatted text in a monospaced font.
    Verbatim(String),
    /// Parts behind a heading that opens on demand; they are printed only when open.
    Folded {
        /// The heading.
        heading: String,
        /// The parts.
        blocks: Vec<Block>,
    },
    /// A part that a script of this kind of page moves. `html` is not escaped: it must be the
    /// program's own.
    Viewer {
        /// Name of the element that holds the part.
        id: &'static str,
        /// Its controls.
        html: &'static str,
        /// The blocks that the script moves; charts without curves are seen only while it does.
        blocks: Vec<Block>,
        /// Name of the element that holds the data.
        data_id: &'static str,
        /// The data.
        data: Value,
        /// The script.
        script: &'static str,
    },
}

impl Block {
    /// Charts side by side if there is space.
    pub fn charts(charts: impl IntoIterator<Item = Chart>) -> Self {
        Self::Beside(charts.into_iter().map(Self::Chart).collect())
    }
}

impl Fact {
    /// The figure `name`.
    pub fn new(name: impl Into<String>, value: impl Into<String>, note: impl Into<String>) -> Self {
        Self { name: name.into(), value: value.into(), note: note.into() }
    }
}

/// A section with a heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Name of the element, unique on the page: letters, digits, hyphens.
    pub id: String,
    /// The heading.
    pub heading: String,
    /// Its parts.
    pub blocks: Vec<Block>,
}

impl Section {
    /// The section `heading` of `blocks`, as the element `id`.
    pub fn new(id: impl Into<String>, heading: impl Into<String>, blocks: Vec<Block>) -> Self {
        Self { id: id.into(), heading: heading.into(), blocks }
    }
}

/// One line in the colour of its level, first on its page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Banner {
    /// The level, as the name of its colour: `ok`, `act`, `unknown`, `stop` or `outside`.
    pub level: &'static str,
    /// The level in words.
    pub word: &'static str,
    /// The reason.
    pub text: String,
}

/// A page under construction: one HTML file that needs no network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title of the page: that of the case.
    pub title: String,
    /// Kind of results: "Crack growth".
    pub kind: String,
    /// The decision, where there is one: what it is and why.
    pub decision: Option<Banner>,
    /// The main result in one or two sentences.
    pub verdict: String,
    /// Key figures.
    pub facts: Vec<Fact>,
    /// Blocks of the first screen, below the key figures.
    pub lead: Vec<Block>,
    /// Everything else.
    pub sections: Vec<Section>,
}

/// The permissions of a page: run its own scripts and, in a worker, its own module; ask the server
/// that sent it, as `railcrack view` does, and nobody else.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; \
    worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; \
    base-uri 'none'; form-action 'none'";

impl Page {
    /// The file.
    pub fn html(&self) -> String {
        let mut page = String::with_capacity(1 << 20);
        self.write(&mut page);
        page
    }

    // Writing to a string does not fail.
    fn write(&self, page: &mut String) {
        let (title, kind) = (escaped(&self.title), typeset(&self.kind));
        let _ = write!(
            page,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <meta name=\"generator\" content=\"railcrack {VERSION}\">\n\
             <link rel=\"icon\" href=\"data:,\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n\
             <p class=\"kind\">{kind} \u{b7} railcrack {VERSION}</p>\n<h1>{title}</h1>\n"
        );
        self.write_contents(page);
        let _ = writeln!(page, "</header>\n<main>\n<section id=\"result\" aria-label=\"Result\">");
        if let Some(Banner { level, word, text }) = &self.decision {
            let text = typeset(text);
            let _ = writeln!(
                page,
                "<p class=\"decision {level}\" role=\"status\"><strong>{word}</strong> {text}</p>"
            );
        }
        let _ = writeln!(page, "<p class=\"verdict\">{}</p>", typeset(&self.verdict));
        page.push_str("<dl class=\"facts\">\n");
        for fact in &self.facts {
            let [name, value, note] =
                [&fact.name, &fact.value, &fact.note].map(|text| typeset_in_parts(text));
            let _ = write!(page, "<div><dt>{name}</dt><dd>{value}");
            if !note.is_empty() {
                let _ = write!(page, "<small>{note}</small>");
            }
            page.push_str("</dd></div>\n");
        }
        page.push_str("</dl>\n");
        let mut scripts = Vec::new();
        write_blocks(page, &self.lead, &mut scripts);
        page.push_str("</section>\n");
        for section in &self.sections {
            let (id, heading) = (escaped(&section.id), typeset(&section.heading));
            let is_folded = section.blocks.iter().all(|block| matches!(block, Block::Folded { .. }));
            let class = if is_folded { " class=\"folded\"" } else { "" };
            let _ = writeln!(
                page,
                "<section id=\"{id}\"{class} aria-labelledby=\"{id}-heading\">\n<h2 id=\"{id}-heading\">{heading}</h2>"
            );
            write_blocks(page, &section.blocks, &mut scripts);
            page.push_str("</section>\n");
        }
        page.push_str("</main>\n");
        for script in std::iter::once(COMMON).chain(scripts) {
            let _ = writeln!(page, "<script>\n{}</script>", without_comments(script));
        }
        page.push_str("</body>\n</html>\n");
    }

    fn write_contents(&self, page: &mut String) {
        page.push_str("<nav aria-label=\"Contents\"><ul>");
        for Section { id, heading, .. } in &self.sections {
            let _ = write!(page, "<li><a href=\"#{}\">{}</a></li>", escaped(id), typeset(heading));
        }
        page.push_str("</ul></nav>\n");
    }
}

/// A script of this crate without lines that are comments, and without indentation.
fn without_comments(script: &str) -> String {
    let is_code = |line: &&str| {
        let opens = line.starts_with("/*") && (line.ends_with("*/") || !line.contains("*/"));
        !(line.is_empty() || opens || ["//", "* ", "*/"].iter().any(|start| line.starts_with(start)))
    };
    script.lines().map(str::trim).filter(is_code).flat_map(|line| [line, "\n"]).collect()
}

fn write_blocks(page: &mut String, blocks: &[Block], scripts: &mut Vec<&'static str>) {
    for block in blocks {
        let _ = match block {
            Block::Heading(text) => writeln!(page, "<h3 class=\"lead\">{}</h3>", typeset(text)),
            Block::Text(text) => writeln!(page, "<p>{}</p>", typeset(text)),
            Block::List(items) => write_list(page, "plain", items),
            Block::Warnings(items) => write_list(page, "warnings", items),
            Block::Table(table) => {
                table.write(page);
                Ok(())
            }
            Block::Approval(table) => {
                page.push_str("<div class=\"approval\">");
                table.write(page);
                writeln!(page, "</div>")
            }
            Block::Chart(chart) => {
                chart.write(page);
                Ok(())
            }
            Block::Choices(choices) => {
                scripts.push(CHOICES);
                choices.write(page);
                Ok(())
            }
            Block::Beside(blocks) => {
                page.push_str("<div class=\"beside\">\n");
                write_blocks(page, blocks, scripts);
                writeln!(page, "</div>")
            }
            Block::Picture { svg, caption } => {
                let (picture, caption) = (inlined(svg, caption), typeset(caption));
                writeln!(
                    page,
                    "<figure class=\"picture\"><div class=\"wide\">{picture}</div><figcaption>{caption}</figcaption></figure>"
                )
            }
            Block::Verbatim(text) => writeln!(page, "<pre tabindex=\"0\">{}</pre>", escaped(text)),
            Block::Folded { heading, blocks } => {
                let _ = writeln!(page, "<details><summary>{}</summary>", typeset(heading));
                write_blocks(page, blocks, scripts);
                writeln!(page, "</details>")
            }
            Block::Viewer { id, html, blocks, data_id, data, script } => {
                let _ = writeln!(page, "<div id=\"{id}\" class=\"viewer\">\n{html}");
                write_blocks(page, blocks, scripts);
                scripts.push(script);
                let data = json_for_script(data);
                writeln!(page, "</div><script type=\"application/json\" id=\"{data_id}\">{data}</script>")
            }
        };
    }
}

fn write_list(page: &mut String, class: &str, items: &[String]) -> std::fmt::Result {
    writeln!(page, "<ul class=\"{class}\">")?;
    for item in items {
        writeln!(page, "<li>{}</li>", typeset(item))?;
    }
    writeln!(page, "</ul>")
}
