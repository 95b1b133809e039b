//! From cases to rails and traffic.

mod mutations;
mod ranges;
mod steps;
mod wheels;
mod wheels_in_space;

#[path = "../../../railcrack-case/tests/common/wheels.rs"]
mod cases;
#[path = "../../../railcrack/tests/common/random.rs"]
mod random;
