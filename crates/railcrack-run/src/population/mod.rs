//! Samples between the runs of a study whose values are drawn: inputs that change the path of the
//! crack act by interpolated paths, the scatter of the law by its own deviates.

mod drawn;
mod from_runs;
mod interpolation;
mod lives;
mod shape;
