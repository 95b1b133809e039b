//! Tables of keys, a file for each section: its rows, the words of its choices, and the type that
//! it fills. A new key is a row and the line that reads it.

mod calibration;
mod contact;
mod coupling;
mod crack;
mod file;
mod fluid;
mod fracture;
mod growing;
mod growth;
mod inspection;
mod law;
mod law_keys;
mod maintenance;
mod mesh;
mod output;
mod passage;
mod rail;
mod rolling;
mod shakedown;
mod solver;
mod stress;
mod study;
mod title;
mod track;
mod traffic;
mod wheel_load;

pub use calibration::CalibrationPrior;
pub use contact::{ContactExtent, ContactOrigin, ProfileOrigin};
pub use file::{FileKey, SECTIONS, file_keys, init_text, json_schema, markdown};
pub use fracture::Fracture;
pub use inspection::{Detection, Inspection, InspectionRisk, Scatter};
pub use mesh::MeshSettings;
pub use output::{FieldOutput, Kept, Output};
pub use shakedown::{RollingWheels, ShakedownSettings};
pub use solver::{ContactSolver, Engine, PlaneEngine};
pub use stress::PlasticSource;
pub use study::{Combine, STUDY, Sampling};
pub use wheel_load::{GivenContact, GivenWheel, WheelLoading};

pub(crate) use calibration::{CALIBRATION, read_calibration};
pub(crate) use contact::{CONTACT, COUPLED, KIND, LATERAL_EXTENT, LATERAL_HALF_WIDTH, PossibleExtent};
pub(crate) use crack::{
    ANGLE, ANGLE_SD, ANGLES, COUNT, CRACK, CRACK_DEPTH, CRACK_FRICTION, CRACK_LATERAL, CRACK_TABLE, LENGTH,
    LENGTH_SD, MOUTH, POINTS, ROW_SEED, SPACING, SPACING_SD, STRIKE, SURFACE_HALF_LENGTH,
};
pub(crate) use file::CASE_FILE;
pub(crate) use fluid::{FLUID, read_fluid};
pub(crate) use fracture::FRACTURE;
pub(crate) use growing::{Growing, PathGiven, read_growth};
pub(crate) use growth::{
    CrackSurface, FRONT, FRONT_HARMONICS, FrontForm, GROWTH, LAW, MODE_3_WEIGHT, STEPS, STRAIGHT_BY_DEFAULT,
    STRAIGHT_TO, SURFACE, TURNING_LENGTH, is_of_the_steel,
};
pub(crate) use inspection::{INSPECTION, SCATTER, Scattering, read_inspection, read_risk, read_scatter};
pub(crate) use maintenance::{MAINTENANCE, read_maintenance};
pub(crate) use mesh::{
    ELEMENT_SIZE, INTERFACE_ELEMENTS, INTERFACE_SPACING, MESH, SPACE_CELLS, SPACE_SURFACE_ROWS,
    read_resolution,
};
pub(crate) use output::{EXPLORER, OF_STUDY, OUTPUT, RUN_FOLDERS};
pub(crate) use passage::{FROM, PASSAGE, POSITIONS, TO, check_passage, read_passages, read_travel};
pub(crate) use rail::{
    BOUNDARY, BoundaryKind, CENTRE, CRACKED_SECTION, CrackedSection, RAIL, Rail, WIDTH, read_steel,
};
pub(crate) use shakedown::{SHAKEDOWN, YIELD_STRESS};
pub(crate) use solver::{ENGINE, NETWORK, SOLVER, SOLVER_CONTACT, engine_of};
pub(crate) use stress::{PLASTIC_STRESS, PROFILE, RESIDUAL_STRESS};
pub(crate) use study::{COLOUR_BY, COMBINE, SAMPLES, SAMPLES_BY_DEFAULT, SAMPLING, SEED, TOGETHER};
pub(crate) use title::{TITLE, TOP};
pub(crate) use track::{
    FOUNDATION, RAIL_TEMPERATURE, SEASONS, TEMPERATURE, TRACK, read_seasons, read_temperature, read_track,
};
pub(crate) use traffic::{
    AXLE_LOAD, DIRECTION, MGT_PER_YEAR, PLACE, PLACE_WINDOW, REPRESENTATIVES, REPRESENTATIVES_ERROR, SHARE,
    TABLE, TABLE_EXTENT, TABLE_SIGN, TABLE_THEORY, TRAFFIC, WHEEL, WHEEL_AXLE_LOAD, WHEEL_CONTACT,
    WHEEL_FLUID, WHEEL_NAME, WHEEL_TEMPERATURE, WHEEL_TRACK,
};
pub(crate) use wheel_load::WheelSections;
