//! The commands, one file each.

pub mod calibrate;
pub mod check;
mod check_study;
pub mod compare;
pub mod completions;
pub mod contact;
pub mod explorer;
pub mod init;
pub mod plan;
pub mod report;
pub mod run;
pub mod schema;
pub mod shakedown;
pub mod show;
pub mod sweep;
mod template;
pub mod validate;
pub mod verify;
pub mod view;
