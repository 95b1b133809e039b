//! Functions of the WebAssembly module.
//!
//! The page writes the text of a case to the place that [`input`] returns, calls [`begin`], then
//! [`step`] as often as it returns 0, and whatever else it wants; after each call the text at
//! [`output`] is JSON. The functions return 0; 1: no step follows; 2: an error, which the text
//! lists.

use crate::drawing;
use crate::refusal::Refusal;
use crate::session::Session;
use serde_json::{Value, json};
use std::cell::RefCell;

const DONE: u32 = 0;
const ENDED: u32 = 1;
const REFUSED: u32 = 2;

#[derive(Default)]
struct Page {
    input: Vec<u8>,
    output: Vec<u8>,
    session: Option<Session>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

fn with<T>(call: impl FnOnce(&mut Page) -> T) -> T {
    PAGE.with(|page| call(&mut page.borrow_mut()))
}

impl Page {
    fn answer(&mut self, code: u32, value: &Value) -> u32 {
        self.output = value.to_string().into_bytes();
        code
    }

    fn refuses(&mut self, refusals: &[Refusal]) -> u32 {
        let all: Vec<Value> = refusals.iter().map(Refusal::to_json).collect();
        self.answer(REFUSED, &json!({ "errors": all }))
    }

    /// The answer of the session that was begun.
    fn asked(&mut self, of: impl FnOnce(&mut Session) -> Result<Value, Refusal>) -> u32 {
        let Some(session) = &mut self.session else {
            return self.answer(REFUSED, &json!({ "errors": [{ "message": "no run has begun" }] }));
        };
        match of(session) {
            Ok(value) => {
                let code = if session.has_ended() { ENDED } else { DONE };
                self.answer(code, &value)
            }
            Err(refusal) => self.refuses(&[refusal]),
        }
    }
}

/// Makes room for a text of `length` bytes; its place.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn input(length: usize) -> usize {
    with(|page| {
        page.input = vec![0; length];
        page.input.as_ptr() as usize
    })
}

/// The place of the last answer.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn output() -> usize {
    with(|page| page.output.as_ptr() as usize)
}

/// Bytes of the last answer.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn output_length() -> usize {
    with(|page| page.output.len())
}

/// Begins the run of the case at [`input`].
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn begin() -> u32 {
    with(|page| {
        page.session = None;
        let text = String::from_utf8_lossy(&std::mem::take(&mut page.input)).into_owned();
        match Session::begin(&text) {
            Ok(session) => {
                let case = session.case();
                page.session = Some(session);
                page.answer(DONE, &case)
            }
            Err(refusals) => page.refuses(&refusals),
        }
    })
}

/// Computes the next growth step.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn step() -> u32 {
    with(|page| page.asked(Session::step))
}

/// `summary.json` so far, without samples and other runs.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn summary() -> u32 {
    with(|page| page.asked(|session| Ok(session.summary())))
}

/// `summary.json` with samples and the other runs that the decision needs.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn decide() -> u32 {
    with(|page| page.asked(Session::decide))
}

/// The texts of the tables.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn tables() -> u32 {
    with(|page| page.asked(|session| session.tables()))
}

/// The figure of the chart at [`input`], as a text; null where that is no chart.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "the name of an exported function")]
pub extern "C" fn draw() -> u32 {
    with(|page| {
        let figure = drawing::figure(&std::mem::take(&mut page.input));
        page.answer(DONE, &json!(figure))
    })
}
