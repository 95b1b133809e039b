//! The command as a user meets it, and the book.

mod book;
mod calibrate;
mod case;
mod combinations;
mod common;
mod compare;
mod decision;
mod documents;
mod fluid;
mod loads;
mod long_runs;
mod options;
mod packed;
mod paper;
mod plan;
mod plastic_stress;
mod population;
mod reliability;
mod report;
mod run;
mod shakedown;
mod space;
mod sweep;
mod traffic;
mod validate;
mod view;
