//! The command as a user meets it, and the book.

// Pages run in a shell.
#[cfg(unix)]
mod book;
mod calibrate;
mod case;
mod case_files;
mod combinations;
mod common;
mod compare;
mod contact;
mod counts;
mod coupled;
mod decision;
mod documents;
mod explorer;
mod fluid;
mod inspection_list;
mod loads;
mod long_runs;
mod options;
mod packed;
mod plan;
mod plastic_stress;
mod population;
mod reliability;
mod report;
mod result_folders;
mod run;
mod seasons;
mod shakedown;
mod space;
mod sweep;
mod traffic;
mod validate;
mod verdict;
mod view;
