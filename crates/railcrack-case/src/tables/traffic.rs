//! `[traffic]`: the load that passes.

use crate::schema::{number, positive, section};

section! {
    TRAFFIC "traffic", Optional, "Traffic: with it, cycles are also given in million gross tonnes.";
    AXLE_LOAD: f64 = number("axle_load_t", "t", positive(100.0), 17.0, "Load of one axle; one passage is one axle.")
        .required();
}
