//! What is required of the numbers, in a sentence each.

/// A requirement and the test that holds it.
pub struct Requirement {
    /// Path of the test in the test program `verification`.
    pub test: &'static str,
    /// Which of its measurements; empty for the only one.
    pub quantity: &'static str,
    /// The requirement.
    pub says: &'static str,
}

const fn requirement(test: &'static str, quantity: &'static str, says: &'static str) -> Requirement {
    Requirement { test, quantity, says }
}

/// All that the page docs/verification.md lists, in its order.
pub const REQUIREMENTS: &[Requirement] = &[
    requirement(
        "xfem::edge_crack::tension_by_angle",
        "",
        "X-FEM: a surface crack in tension has the K_I and K_II of the closed forms at 90° to 15° and mirrored.",
    ),
    requirement(
        "xfem::edge_crack::polynomial_pressure",
        "",
        "X-FEM: a surface crack under the face pressure p (x/l)ⁿ, n = 0 to 4, has the published K_I.",
    ),
    requirement(
        "xfem::slant_crack::open_in_tension",
        "",
        "X-FEM: an open slant crack far from the surface has the K of the infinite plate.",
    ),
    requirement(
        "xfem::slant_crack::closed_in_compression",
        "",
        "X-FEM: a slant crack closed in compression has K_I = 0 and K_II = (|τ| − μ |σ_n|) √(πa).",
    ),
    requirement(
        "xfem::convergence::with_a_fixed_enrichment_radius",
        "",
        "X-FEM: K converges in the element size with a fixed enrichment radius.",
    ),
    requirement(
        "xfem::convergence::with_an_enrichment_of_some_elements",
        "",
        "X-FEM: K, work and jumps converge in the element size with the default radius.",
    ),
    requirement(
        "xfem::sif_domain::open",
        "",
        "X-FEM: K of open straight and kinked cracks does not depend on the domain of integration, over a factor of 3.",
    ),
    requirement(
        "xfem::sif_domain::closed_with_friction",
        "",
        "X-FEM: nor does the history of closed, sliding straight and kinked cracks.",
    ),
    requirement(
        "xfem::shifted_mesh::by_fractions_of_an_element",
        "",
        "X-FEM: K does not change when the mesh is shifted by fractions of an element, down to 1e-9 of it.",
    ),
    requirement(
        "xfem::random_cracks::agree_with_dislocations",
        "",
        "X-FEM: K of 1000 random cracks, many through nodes, along edges or leaving slivers, is that of the other engine.",
    ),
    requirement(
        "xfem::random_cracks::agree_with_dislocations",
        "condition",
        "X-FEM: the scaled condition number of C stays bounded over these cracks.",
    ),
    requirement(
        "xfem::random_cracks::through_nodes_and_along_lines",
        "",
        "X-FEM: K of cracks laid exactly through nodes and along mesh lines is that of the other engine.",
    ),
    requirement(
        "xfem::engines::same_response",
        "",
        "Both engines give the same jumps and K under smooth tractions.",
    ),
    requirement(
        "xfem::histories::reference_cases",
        "",
        "X-FEM: every position of the passages of Table 1 and Fig. 13 is on the independent history.",
    ),
    requirement("xfem::histories::angles", "", "X-FEM: so is every position for cracks at 30° to 165°."),
    requirement(
        "xfem::histories::frictions_of_the_faces",
        "",
        "X-FEM: so is every position for face frictions of 0 to 0.8.",
    ),
    requirement(
        "xfem::histories::frictions_of_the_wheel",
        "",
        "X-FEM: so is every position for wheel frictions of −0.4 to 0.4.",
    ),
    requirement(
        "xfem::histories::kinks_of_a_third_of_the_crack",
        "",
        "X-FEM: so is every position for kinks of ±30° and −60°.",
    ),
    requirement(
        "xfem::histories::short_kinks",
        "",
        "X-FEM: so is every position for kinks of ±60° and 0.3 mm.",
    ),
    requirement(
        "xfem::histories::residual_profile",
        "",
        "X-FEM: so is every position with a residual stress profile.",
    ),
    requirement("xfem::histories::pair", "", "X-FEM: so is every position for two cracks that lean apart."),
    requirement(
        "xfem::histories::reference_cases",
        "closed tip",
        "X-FEM: K_I of a closed tip vanishes, over the peak of |K_II|, in Table 1 and Fig. 13.",
    ),
    requirement(
        "xfem::histories::frictions_of_the_wheel",
        "closed tip",
        "X-FEM: K_I of a closed tip vanishes for wheel frictions of −0.4 to 0.4.",
    ),
    requirement(
        "xfem::histories::angles",
        "overlap",
        "X-FEM: faces do not overlap, over the largest opening.",
    ),
    requirement(
        "xfem::contact_pressure::no_oscillation_under_the_wheel",
        "",
        "X-FEM: the contact pressure does not alternate from point to point.",
    ),
    requirement(
        "xfem::clamped_block::table1",
        "",
        "X-FEM: every position of Table 1 in the clamped block is on the history of a conforming model.",
    ),
    requirement("xfem::symmetry::mirrored_passage", "", "X-FEM: a mirrored case has the mirrored history."),
    requirement("xfem::symmetry::far_apart", "", "X-FEM: a second crack 20 lengths away does not matter."),
    requirement(
        "engine_paths::reference_case",
        "",
        "The paths of the two engines stay together over the 25 increments of Table 1 (mm).",
    ),
    requirement("engine_paths::branch_downwards", "", "So do they where the crack branches downwards (mm)."),
    requirement("engine_paths::steep_cracks", "", "So do they for cracks at 45° and 60° (mm)."),
    requirement(
        "edge_crack_in_tension::factors_by_angle",
        "",
        "Dislocations: a surface crack in tension has the K of the closed forms.",
    ),
    requirement(
        "edge_crack_under_pressure::polynomial_pressure",
        "",
        "Dislocations: a surface crack under the face pressure p (x/l)ⁿ has the published K_I.",
    ),
    requirement(
        "edge_crack_under_pressure::residual_stress_alone",
        "",
        "Dislocations: residual stress alone gives the K of the face tractions −σ·n.",
    ),
    requirement(
        "slant_crack::open_in_tension",
        "",
        "Dislocations: an open slant crack has the K of the infinite plate.",
    ),
    requirement(
        "slant_crack::closed_in_compression",
        "",
        "Dislocations: a closed slant crack has K_I = 0 and K_II = (|τ| − μ |σ_n|) √(πa).",
    ),
    requirement(
        "kinked_crack::largest_opening_of_a_kink_in_shear",
        "",
        "A kink of pure mode II opens most at −76.6°, k1 = 1.2316 K_II.",
    ),
    requirement(
        "collinear_cracks::inner_and_outer_tips_in_both_modes",
        "",
        "Dislocations: collinear cracks have the K of the closed form.",
    ),
    requirement(
        "far_apart::equal_the_single_crack",
        "",
        "Dislocations: cracks a thousand lengths apart do not feel each other.",
    ),
    requirement(
        "half_plane_histories::reference_cases",
        "",
        "Dislocations: every position of Table 1 and Fig. 13 is on the independent history.",
    ),
    requirement(
        "half_plane_histories::angles",
        "",
        "Dislocations: so is every position for cracks at 30° to 165°.",
    ),
    requirement(
        "half_plane_histories::frictions_of_the_faces",
        "",
        "Dislocations: so is every position for face frictions of 0 to 0.8.",
    ),
    requirement(
        "half_plane_histories::frictions_of_the_wheel",
        "",
        "Dislocations: so is every position for wheel frictions of −0.4 to 0.4.",
    ),
    requirement(
        "closed_tip::closed_tips_have_no_opening_mode",
        "",
        "Dislocations: closed tips have no K_I, and the law of the faces holds.",
    ),
    requirement(
        "latin_and_newton::straight_cracks",
        "",
        "LATIN and Newton give the same tractions and K on the same steps.",
    ),
    requirement(
        "step_tolerance::error_falls_with_the_tolerance",
        "",
        "The error of the load steps stays below their tolerance.",
    ),
    requirement(
        "junctions::buried_crack_in_two_pieces",
        "",
        "Dislocations: a crack in two joined pieces has the K of one piece, in tension and shear.",
    ),
    requirement("junctions::surface_crack_in_two_pieces", "", "Dislocations: so has a surface crack."),
    requirement(
        "junctions::surface_crack_in_two_pieces_under_the_wheel",
        "",
        "Dislocations: so has a surface crack under the wheel, closed and slipping.",
    ),
    requirement(
        "junctions::branched_cracks",
        "",
        "Dislocations: line, cross, star and an unsymmetric branch have the K of an independent computation.",
    ),
    requirement(
        "junctions::junction_loses_and_doubles_no_traction",
        "",
        "Dislocations: a junction loses and doubles no traction.",
    ),
    requirement(
        "junctions::closed_branch_is_no_branch",
        "",
        "Dislocations: a branch that is pressed together and sticks changes nothing.",
    ),
    requirement(
        "junctions::energy_is_continuous_at_the_junction",
        "",
        "Dislocations: the energy is continuous when a tip comes to a free crack and joins it.",
    ),
    requirement(
        "junctions::energy_release_of_a_tip_that_comes_to_a_free_crack",
        "",
        "Dislocations: the energy release rate of a tip that comes to a free crack is that of its K.",
    ),
    requirement(
        "junctions::mirrored_junctions",
        "",
        "Dislocations: mirrored cracks that meet have the mirrored history.",
    ),
    requirement(
        "junction_run::against_a_finer_mesh",
        "",
        "Dislocations: K after a junction under the wheel is that of four times the elements.",
    ),
    requirement(
        "junction_run::area_of_the_spall",
        "",
        "Dislocations: the spall of the junction case has the area of the run with twice the elements.",
    ),
    requirement("mirror::passage", "", "Dislocations: a mirrored case has the mirrored history."),
    requirement(
        "plastic_stress::engines_agree",
        "",
        "Engines: a crack in layers of balanced stress, and of plastic stress that is balanced on the mesh first, has the same K in both.",
    ),
    requirement(
        "plastic_stress::rolled_rail_balances_to_its_own_residual_stress",
        "stress",
        "Plastic stress: that of a rolled rail, projected and balanced on the mesh of the crack, is its residual stress again.",
    ),
    requirement(
        "plastic_stress::rolled_rail_balances_to_its_own_residual_stress",
        "norm",
        "Plastic stress: its norm survives the way from cells to nodes.",
    ),
    requirement(
        "step_tolerance::fixed_steps_lock_too_little_slip",
        "",
        "Load steps: fixed ones of 0.1 a, 0.05 a and 0.02 a are off by what two independent codes with such steps were off by.",
    ),
    requirement(
        "xfem::junctions::a_crack_in_two_pieces_is_that_crack",
        "",
        "X-FEM: a crack in two joined pieces has the K of one piece, open and under the wheel.",
    ),
    requirement(
        "xfem::junctions::a_t_junction_is_that_of_the_other_engine",
        "",
        "Engines: a T-junction has the same K in both, open, closed with friction and without.",
    ),
    requirement(
        "xfem::junctions::no_traction_is_lost_or_doubled",
        "",
        "X-FEM: a junction loses and doubles no traction.",
    ),
    requirement(
        "xfem::junctions::mirrored_junctions",
        "",
        "X-FEM: mirrored cracks that meet have the mirrored history.",
    ),
    requirement(
        "xfem::neighbours::tips_near_others_and_the_surface",
        "",
        "Engines: tips near other cracks and near the surface have the same K in both.",
    ),
    requirement(
        "xfem::neighbours::several_cracks_in_one_element",
        "",
        "Engines: so have cracks that pass through the same elements.",
    ),
    requirement(
        "xfem::neighbours::domains_over_a_neighbour",
        "",
        "X-FEM: K does not depend on whether the domain of integration holds a neighbour.",
    ),
    requirement(
        "xfem::networks::squat_pair",
        "",
        "Engines: each crack of a squat has the same K in both, over its own peak, also when it has grown.",
    ),
    requirement("xfem::networks::nine_parallel_cracks", "", "Engines: so has each of nine parallel cracks."),
    requirement(
        "xfem::networks::nine_parallel_cracks_of_a_run",
        "",
        "Engines: so has each of nine cracks of a run, at every position.",
    ),
    requirement(
        "xfem::networks::a_tip_that_sticks_keeps_its_k",
        "",
        "X-FEM: a tip that sticks keeps its K, and K does not jump when the tip lets go.",
    ),
    requirement(
        "slow_tips::k_of_the_slow_tip_of_a_squat",
        "",
        "X-FEM: K of a tip that is much slower than another is resolved on its way, behind a turn of 76°.",
    ),
    requirement(
        "slow_tips::taken_up_while_a_tip_waits",
        "",
        "Growth of a slow tip waits for a whole increment, and leads to the same place in both engines (mm).",
    ),
    requirement(
        "xfem::unlike_lengths::a_short_crack_beside_a_long_one",
        "",
        "Engines: a short crack beside a long one has the same K in both, over its own peak.",
    ),
    requirement("xfem::unlike_lengths::no_unit_of_length", "", "X-FEM: C and K know no unit of length."),
    requirement(
        "xfem::short_increments::increments_of_a_run",
        "",
        "Engines: tips that have turned and gone on by 4 % of the crack have the same K in both.",
    ),
    requirement(
        "xfem::short_increments::small_turns_of_slow_tips",
        "",
        "Engines: so have, roughly, tips that have gone on by less than an element.",
    ),
    requirement(
        "far_apart::twenty_lengths_away",
        "",
        "Dislocations: a crack 20 lengths away changes K by less than 1 %.",
    ),
    requirement(
        "latin_and_newton::junction_of_cracks",
        "",
        "Contact: LATIN and Newton agree on cracks that meet, in both engines.",
    ),
    requirement(
        "junction_run::by_finite_elements",
        "",
        "Engines: the junction case has the same spall in both.",
    ),
];
