//! Runs of railcrack within a web page: the text of a case in, JSON and tables out.
//!
//! The crate is compiled to WebAssembly for `railcrack-web.js`, which runs it in a worker of the
//! page. A [`Session`] computes one growth step at a time, so that the page shows every step and
//! can stop between two of them. A page has no files, threads or clock: what needs them is refused
//! with a sentence, and wall times are zero.

#[cfg(any(target_arch = "wasm32", test))]
mod drawing;
#[cfg(target_arch = "wasm32")]
mod exports;
mod refusal;
mod session;
mod step_json;

pub use refusal::Refusal;
pub use session::Session;
