//! Tables of wheels: one row per wheel and patch.

use super::columns::{Column, Columned, Columns, LARGEST};
use super::companion::{CaseFile, read_named};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::load::{HertzEllipse, WheelOnRail};
use railcrack::material::IsotropicElastic;
use railcrack::rolling::{Creepage, CreepageSign, PlacedPatch, RollingPatch, RollingTheory};
use std::collections::{BTreeMap, HashMap};
use std::f64::consts::PI;
use std::ops::RangeInclusive;
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[
        Column::Needed("wheel"),
        Column::Needed("normal_kn"),
        Column::Needed("y_rail_mm"),
        Column::Needed("creepage_x"),
        Column::Needed("creepage_y"),
        Column::Needed("spin_per_mm"),
        Column::Needed("mu"),
        Column::Blank("place_m"),
        Column::Blank("patch"),
        Column::Blank("share"),
        Column::Blank("axle_load_t"),
        Column::Blank("angle_deg"),
        Column::Blank("x_mm"),
        Column::Blank("a_mm"),
        Column::Blank("b_mm"),
        Column::BlankRadius("rail_radius_mm"),
        Column::Blank("wheel_radius_mm"),
        Column::BlankRadius("wheel_profile_radius_mm"),
    ],
    largest: LARGEST,
    help: "a table of wheels has a row per wheel and patch, with the columns wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu, and a_mm,b_mm or rail_radius_mm,wheel_radius_mm; place_m, patch, share, axle_load_t, angle_deg, x_mm and wheel_profile_radius_mm may be left out",
};

/// Farthest place of a patch from the middle of the rail head along the running surface, mm: the
/// gauge face of a 60 kg/m rail ends there.
const RAIL_HEAD: f64 = 50.0;

/// Columns of the place and of the number of the patch.
const AT: usize = 7;
const PATCH: usize = 8;

/// Shares whose sum differs from 1 by less add up to 1: a thousand of them were rounded.
const SUM: f64 = 1e-3;

/// A patch of a wheel in a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TablePatch {
    /// Pressure, creepages, friction.
    pub patch: RollingPatch,
    /// Lateral place of its middle on the running surface, mm.
    pub y_rail: f64,
    /// x of its middle from the wheel's centre, with the travel, mm.
    pub x: f64,
    /// Contact angle, rad: positive where the rail falls towards +y; none where it is not given.
    pub angle: Option<f64>,
    /// Radius of the wheel, mm; none where the semi-axes are given.
    pub wheel_radius: Option<f64>,
}

/// A wheel in a table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableWheel {
    /// Its number in the table.
    pub number: u64,
    /// Its place along the track, m.
    pub place: Option<f64>,
    /// Share of the axles; none where the table has no shares.
    pub share: Option<f64>,
    /// Axle load, t.
    pub axle_load: Option<f64>,
    /// Its patches on this rail.
    pub patches: Vec<TablePatch>,
}

impl TableWheel {
    /// The patch that carries most; every wheel has one.
    #[must_use]
    pub fn heaviest(&self) -> &TablePatch {
        let load = |own: &TablePatch| own.patch.normal_force();
        let rest = self.patches.iter().skip(1);
        rest.fold(&self.patches[0], |most, own| if load(own) > load(most) { own } else { most })
    }

    /// The patches with the place of a crack at `lateral` (mm, as `y_rail`) in each of them.
    #[must_use]
    pub fn over(&self, lateral: f64) -> Vec<PlacedPatch> {
        let placed = |own: &TablePatch| PlacedPatch { patch: own.patch, y: lateral - own.y_rail, x: own.x };
        self.patches.iter().map(placed).collect()
    }
}

/// A table of wheels and the text it was read from.
pub type WheelTableFile = CaseFile<Vec<TableWheel>>;

/// Properties of the wheels that are not in the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WheelReading<'a> {
    pub steel: &'a IsotropicElastic,
    pub sign: CreepageSign,
    pub theory: RollingTheory,
}

/// The wheels in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_wheel_table(
    section: &SectionValues,
    row: KeyRow<String>,
    reading: WheelReading<'_>,
    folder: &Path,
    report: &mut Report,
) -> Option<WheelTableFile> {
    read_named(section, row, folder, report, &COLUMNS, |source| parse(source, reading))
}

fn parse(source: &Source, reading: WheelReading<'_>) -> Result<Vec<TableWheel>, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    if read.rows.is_empty() {
        return Err(COLUMNS.fault_of_row(&read, 0, "no rows: a table of wheels needs one at least".into()));
    }
    let mut wheels: Vec<TableWheel> = Vec::new();
    let mut known: HashMap<(u64, u64), usize> = HashMap::new();
    // The row, and the number if one is given, of each patch of each wheel.
    let mut origins: Vec<Vec<PatchOrigin>> = Vec::new();
    for (i, row) in read.rows.iter().enumerate() {
        let fault = |message: String| COLUMNS.fault_of_row(&read, i + 1, format!("row {}: {message}", i + 1));
        let (own, patch) = wheel_of(row, reading).map_err(fault)?;
        let origin = PatchOrigin { row: i + 1, number: Some(row[PATCH]).filter(|number| !number.is_nan()) };
        let key = (own.number, own.place.map_or(u64::MAX, f64::to_bits));
        match known.get(&key) {
            None => {
                known.insert(key, wheels.len());
                origins.push(vec![origin]);
                wheels.push(TableWheel { patches: vec![patch], ..own });
            }
            Some(&other) => {
                let wheel = &mut wheels[other];
                if (wheel.share, wheel.axle_load) != (own.share, own.axle_load) {
                    let message = format!(
                        "`wheel = {}`: its patches have different share or axle_load_t; both belong to the wheel",
                        own.number
                    );
                    return Err(fault(message));
                }
                let mut before = origins[other].iter().zip(&wheel.patches);
                if let Some((first, _)) = before.find(|(first, of)| origin.repeats(first, &patch, of)) {
                    return Err(fault(repetition(own.number, first.row)));
                }
                origins[other].push(origin);
                wheel.patches.push(patch);
            }
        }
    }
    check_shares(&wheels, &read)?;
    Ok(wheels)
}

/// Where a patch of a wheel stands in its table.
#[derive(Debug, Clone, Copy)]
struct PatchOrigin {
    /// From 1.
    row: usize,
    /// Its number, where the table gives it.
    number: Option<f64>,
}

impl PatchOrigin {
    /// Whether `patch`, which stands here, is the patch `of` the `first` place once more: the same
    /// number, or the middle of one lies within the other. Patches of one wheel lie side by side.
    fn repeats(&self, first: &Self, patch: &TablePatch, of: &TablePatch) -> bool {
        let [one, other] = [patch.patch.ellipse, of.patch.ellipse];
        let [along, across] = [one.along.max(other.along), one.across.max(other.across)];
        let is_within = ((patch.x - of.x) / along).hypot((patch.y_rail - of.y_rail) / across) < 1.0;
        is_within || self.number.is_some() && self.number == first.number
    }
}

/// The fault of a row that is the patch of `wheel` in row `first` once more.
fn repetition(wheel: u64, first: usize) -> String {
    format!(
        "is the patch of wheel {wheel} in row {first} once more: the loads of the patches of a wheel add up, and \
         they lie side by side; other times or runs of a wheel have a number or a place_m of their own"
    )
}

/// Shares of all wheels or of none, adding up to 1; with places, to no more than 1 at each of them.
fn check_shares(wheels: &[TableWheel], read: &Columned) -> Result<(), Box<Fault>> {
    let given = wheels.iter().filter(|wheel| wheel.share.is_some()).count();
    if given == 0 {
        return Ok(());
    }
    let whole = |message: String| COLUMNS.fault_of_row(read, read.rows.len(), message);
    if given < wheels.len() {
        return Err(whole(format!(
            "`share` is given for {given} of {} wheels; give it for all or none",
            wheels.len()
        )));
    }
    let sum: f64 = wheels.iter().filter_map(|wheel| wheel.share).sum();
    if wheels.iter().all(|wheel| wheel.place.is_none()) {
        if (sum - 1.0).abs() <= SUM {
            return Ok(());
        }
        return Err(whole(format!(
            "`share`: the shares of all wheels add up to {sum}; they must add up to 1"
        )));
    }
    let mut at_places: BTreeMap<u64, f64> = BTreeMap::new();
    for wheel in wheels {
        *at_places.entry(wheel.place.map_or(u64::MAX, f64::to_bits)).or_default() +=
            wheel.share.unwrap_or(0.0);
    }
    let too_many = at_places.into_iter().find(|(_, sum)| *sum > 1.0 + SUM);
    let Some((place, sum)) = too_many else { return Ok(()) };
    let is_there =
        |row: &Vec<f64>| if place == u64::MAX { row[AT].is_nan() } else { row[AT].to_bits() == place };
    let last = read.rows.iter().rposition(is_there).map_or(0, |row| row + 1);
    let named = match place {
        u64::MAX => "without place_m".to_owned(),
        bits => format!("at place_m = {}", f64::from_bits(bits)),
    };
    Err(COLUMNS.fault_of_row(
        read,
        last,
        format!(
            "row {last}: `share`: the shares of the wheels {named} add up to {sum}; at one place they must not \
             add up to more than 1"
        ),
    ))
}

/// Semi-axes of a patch, mm.
const SEMI_AXES: RangeInclusive<f64> = 0.01..=100.0;
/// Peak pressures of a patch, MPa, as of `[contact]`.
const PRESSURES: RangeInclusive<f64> = 1e-3..=1e4;

/// A row of the table; NaN where a field is missing or blank.
#[derive(Debug, Clone, Copy)]
struct WheelRow {
    wheel: f64,
    patch: f64,
    /// kN.
    normal: f64,
    y_rail: f64,
    x: f64,
    creepage: Creepage,
    friction: f64,
    place: f64,
    share: f64,
    axle_load: f64,
    angle: f64,
    semi_axes: [f64; 2],
    rail_radius: f64,
    wheel_radius: f64,
    profile_radius: f64,
}

impl WheelRow {
    /// The values of the columns of [`COLUMNS`]; none of another number of them.
    fn of(row: &[f64]) -> Option<Self> {
        let &[wheel, normal, y_rail, longitudinal, lateral, spin, friction, ref rest @ ..] = row else {
            return None;
        };
        let &[place, patch, share, axle_load, angle, x, a, b, rail_radius, wheel_radius, profile_radius] =
            rest
        else {
            return None;
        };
        let creepage = Creepage { longitudinal, lateral, spin };
        let semi_axes = [a, b];
        Some(Self {
            wheel,
            patch,
            normal,
            y_rail,
            x,
            creepage,
            friction,
            place,
            share,
            axle_load,
            angle,
            semi_axes,
            rail_radius,
            wheel_radius,
            profile_radius,
        })
    }

    /// Whether each number is one that is accepted; if not, which is and what is accepted.
    fn check(&self) -> Result<(), String> {
        let whole = |value: f64| value >= 0.0 && value.fract() == 0.0;
        let blank_or = |value: f64, fine: bool| value.is_nan() || fine;
        let Creepage { longitudinal, lateral, spin } = self.creepage;
        let moves = [longitudinal, lateral, spin].iter().any(|creepage| *creepage != 0.0);
        let (wheel, patch, share) = (self.wheel, self.patch, self.share);
        within("wheel", wheel, whole(wheel), "a whole number, zero or more")?;
        within("patch", patch, blank_or(patch, whole(patch)), "a whole number, zero or more")?;
        let accepted = "a number in [0.001, 1e4] kN: a wheel without load has no row";
        within("normal_kn", self.normal, self.normal >= 1e-3, accepted)?;
        within("normal_kn", self.normal, self.normal <= 1e4, "a number in [0.001, 1e4] kN")?;
        let on_rail = "in [-50, 50] mm: the patch lies off the rail head";
        within("y_rail_mm", self.y_rail, self.y_rail.abs() <= RAIL_HEAD, on_rail)?;
        for (name, value) in [("creepage_x", longitudinal), ("creepage_y", lateral), ("spin_per_mm", spin)] {
            within(name, value, value.abs() <= 1.0, "a number in [-1, 1]")?;
        }
        within("mu", self.friction, (0.0..=1.0).contains(&self.friction), "a number in [0, 1]")?;
        let grips = self.friction > 0.0 || !moves;
        within("mu", self.friction, grips, "positive where there is creepage or spin")?;
        within("share", share, blank_or(share, share > 0.0 && share <= 1.0), "in (0, 1]")?;
        let loaded = blank_or(self.axle_load, (1e-3..=100.0).contains(&self.axle_load));
        within("axle_load_t", self.axle_load, loaded, "a number in [0.001, 100] t")?;
        let steep = blank_or(self.angle, self.angle.abs() <= 90.0);
        within("angle_deg", self.angle, steep, "in [-90, 90] degrees")?;
        within("x_mm", self.x, blank_or(self.x, self.x.abs() <= 200.0), "in [-200, 200] mm")
    }

    /// The ellipse of its patch, by its semi-axes or by the radii of wheel and rail.
    fn ellipse(&self, steel: &IsotropicElastic) -> Result<HertzEllipse, String> {
        let [a, b] = self.semi_axes;
        both(("a_mm", a), ("b_mm", b))?;
        both(("rail_radius_mm", self.rail_radius), ("wheel_radius_mm", self.wheel_radius))?;
        let force = 1e3 * self.normal;
        let ellipse = match (a.is_nan(), self.rail_radius.is_nan()) {
            (false, true) => {
                within("a_mm", a, SEMI_AXES.contains(&a), "a number in [0.01, 100] mm")?;
                within("b_mm", b, SEMI_AXES.contains(&b), "a number in [0.01, 100] mm")?;
                HertzEllipse { peak_pressure: 1.5 * force / (PI * a * b), along: a, across: b }
            }
            (true, false) => self.hertz(force, steel)?,
            (true, true) => {
                return Err(
                    "`a_mm` and `b_mm`, or `rail_radius_mm` and `wheel_radius_mm`, are missing".into()
                );
            }
            (false, false) => {
                return Err("`a_mm` says the same thing as `rail_radius_mm`: give one or the other".into());
            }
        };
        let HertzEllipse { peak_pressure, along, across } = ellipse;
        let is_sized = SEMI_AXES.contains(&along) && SEMI_AXES.contains(&across);
        if is_sized && PRESSURES.contains(&peak_pressure) {
            return Ok(ellipse);
        }
        Err(format!(
            "`normal_kn = {}`: gives a patch with a = {along:.4} mm, b = {across:.4} mm and a peak pressure of \
             {peak_pressure:.4e} MPa, which must be in [0.01, 100] mm and [0.001, 1e4] MPa",
            self.normal
        ))
    }

    /// The ellipse under `force` (N) by the radii.
    fn hertz(&self, force: f64, steel: &IsotropicElastic) -> Result<HertzEllipse, String> {
        let profile = self.profile_radius;
        within("rail_radius_mm", self.rail_radius, self.rail_radius > 0.0, "positive")?;
        within("wheel_radius_mm", self.wheel_radius, self.wheel_radius > 0.0, "positive")?;
        within("wheel_profile_radius_mm", profile, profile != 0.0, "other than 0; blank or inf: straight")?;
        let on_rail = WheelOnRail {
            wheel_load: force,
            wheel_radius: self.wheel_radius,
            rail_head_radius: self.rail_radius,
            wheel_profile_radius: if profile.is_nan() { f64::INFINITY } else { profile },
        };
        HertzEllipse::new(&on_rail, steel)
            .map_err(|error| format!("`wheel_profile_radius_mm = {profile}`: {error}"))
    }
}

/// An error unless the value of the column `name` is `fine`.
fn within(name: &str, value: f64, fine: bool, accepted: &str) -> Result<(), String> {
    if fine { Ok(()) } else { Err(format!("`{name} = {value}`: must be {accepted}")) }
}

/// Two columns that are given together or not at all.
fn both(one: (&str, f64), other: (&str, f64)) -> Result<(), String> {
    match (one.1.is_nan(), other.1.is_nan()) {
        (true, false) => Err(format!("`{}` is missing: it belongs to `{}`", one.0, other.0)),
        (false, true) => Err(format!("`{}` is missing: it belongs to `{}`", other.0, one.0)),
        _ => Ok(()),
    }
}

/// The wheel and the patch of a row; or what is wrong with which column.
fn wheel_of(row: &[f64], reading: WheelReading<'_>) -> Result<(TableWheel, TablePatch), String> {
    let row = WheelRow::of(row).ok_or("its columns are not those of a table of wheels")?;
    row.check()?;
    let patch = RollingPatch {
        ellipse: row.ellipse(reading.steel)?,
        outline: None,
        friction: row.friction,
        creepage: reading.sign.read(row.creepage),
        steel: *reading.steel,
        theory: reading.theory,
    };
    patch.check().map_err(|error| error.to_string())?;
    let given = |value: f64| (!value.is_nan()).then_some(value);
    let wheel = TableWheel {
        number: row.wheel as u64,
        place: given(row.place),
        share: given(row.share),
        axle_load: given(row.axle_load),
        patches: Vec::new(),
    };
    let (x, angle) = (given(row.x).unwrap_or(0.0), given(row.angle).map(f64::to_radians));
    Ok((wheel, TablePatch { patch, y_rail: row.y_rail, x, angle, wheel_radius: given(row.wheel_radius) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm,share\n";

    fn parsed(text: &str) -> Result<Vec<TableWheel>, String> {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let reading =
            WheelReading { steel: &steel, sign: CreepageSign::Vehicle, theory: RollingTheory::FaStrip };
        parse(&Source::new("w.csv", text), reading).map_err(|fault| fault.message)
    }

    #[test]
    fn patches_of_a_wheel_belong_together() {
        let rows =
            "1,80,2,-1e-3,0,0,0.3,6,5,0.5\n1,10,20,-1e-3,0,0,0.3,4,2,0.5\n7,80,2,1e-3,0,0,0.3,6,5,0.5\n";
        let wheels = parsed(&format!("{HEADER}{rows}")).unwrap();
        assert_eq!((wheels.len(), wheels[0].patches.len(), wheels[1].number), (2, 2, 7));
        assert_eq!(wheels[0].patches[0].patch.creepage.longitudinal, 1e-3, "vehicle signs are opposite");
        assert_eq!(wheels[0].over(5.0)[1].y, -15.0);
        let exported =
            "time_s,side,wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm\n";
        let text = format!("{exported}0.1,R,1,80,2,0,0,0,0.3,6,5\n0.2,\"R, outer\",2,80,2,0,0,0,0.3,6,5\n");
        assert_eq!(parsed(&text).unwrap().len(), 2);
        assert_eq!(COLUMNS.unused_of(&Source::new("w.csv", &text)), ["time_s", "side"]);
    }

    #[test]
    fn a_patch_that_is_given_twice_is_refused() {
        let header =
            "wheel,patch,place_m,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm\n";
        let of = |rows: &str| parsed(&format!("{header}{rows}"));
        let refused = |rows: &str| of(rows).unwrap_err();
        let says = "row 2: is the patch of wheel 1 in row 1 once more";
        assert!(refused("1,,,80,2,0,0,0,0.3,6,5\n1,,,80,2,0,0,0,0.3,6,5\n").starts_with(says));
        // A sample of another time, and a number that is there.
        assert!(refused("1,,,80,2,0,0,0,0.3,6,5\n1,,,76,4.5,0,0,0,0.3,6,5\n").starts_with(says));
        assert!(refused("1,1,,80,2,0,0,0,0.3,6,5\n1,1,,20,30,0,0,0,0.3,6,5\n").starts_with(says));
        // Side by side, at another place, and another wheel.
        assert_eq!(of("1,1,,80,2,0,0,0,0.3,6,5\n1,2,,20,9,0,0,0,0.3,4,2\n").unwrap()[0].patches.len(), 2);
        assert_eq!(of("1,,5,80,2,0,0,0,0.3,6,5\n1,,9,80,2,0,0,0,0.3,6,5\n").unwrap().len(), 2);
        assert_eq!(of("1,,,80,2,0,0,0,0.3,6,5\n2,,,80,2,0,0,0,0.3,6,5\n").unwrap().len(), 2);
    }

    #[test]
    fn a_straight_profile_has_an_infinite_radius() {
        let header = "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,rail_radius_mm,wheel_radius_mm,wheel_profile_radius_mm\n";
        let ellipse = |radii: &str| {
            let wheels = parsed(&format!("{header}1,80,2,0,0,0,0.3,{radii}\n"))?;
            Ok::<_, String>(wheels[0].patches[0].patch.ellipse)
        };
        let blank = ellipse("300,460,").unwrap();
        assert!(
            ["inf", "-inf", "Inf"].iter().all(|one| ellipse(&format!("300,460,{one}")).unwrap() == blank)
        );
        assert!(ellipse("inf,460,500").is_ok());
        assert!(ellipse("300,inf,500").unwrap_err().contains("`wheel_radius_mm = inf`"));
    }

    #[test]
    fn refused_with_row_and_column() {
        let refused = |row: &str| parsed(&format!("{HEADER}1,80,2,0,0,0,0.3,6,5,0.5\n{row}\n")).unwrap_err();
        assert!(refused("2,0,2,0,0,0,0.3,6,5,0.5").starts_with("row 2: `normal_kn = 0`: must be"));
        assert!(
            refused("2,80,200,0,0,0,0.3,6,5,0.5").starts_with("row 2: `y_rail_mm = 200`: must be in [-50")
        );
        assert!(refused("2,80,2,1e-3,0,0,0,6,5,0.5").starts_with("row 2: `mu = 0`: must be positive where"));
        assert!(refused("2,80,2,0,0,0,0.3,6,5,0.7").contains("add up to 1.2; they must add up to 1"));
        assert!(refused("2,80,2,0,0,0,0.3,6,5,0").contains("`share = 0`: must be in (0, 1]"));
        assert!(refused("2,80,2,0,0,0,0.3,6,5,").contains("`share` is given for 1 of 2 wheels"));
        assert!(refused("1,80,2,0,0,0,0.3,6,5,0.4").contains("different share or axle_load_t"));
        assert!(refused("2,80,2,0,0,0,0.3,-6,5,0.5").contains("row 2: `a_mm = -6`"));
        assert!(refused("2,80,2,0,0,0,0.3,,,0.5").contains("`a_mm` and `b_mm`, or"));
        assert!(refused("2.5,80,2,0,0,0,0.3,6,5,0.5").contains("`wheel = 2.5`: must be a whole number"));
        assert!(parsed("wheel,normal\n1,2\n").unwrap_err().contains("unknown column `normal`"));
        assert!(parsed(HEADER).unwrap_err().contains("no rows"));
    }
}
