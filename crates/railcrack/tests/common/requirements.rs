//! Requirements on the accuracy of results, in one sentence each.

/// A requirement and the test that checks it.
pub struct Requirement {
    /// Path of the test in the test program `verification`.
    pub test: &'static str,
    /// The measurement of the test that is meant; empty for the only one.
    pub quantity: &'static str,
    /// The requirement.
    pub says: &'static str,
}

const fn requirement(test: &'static str, quantity: &'static str, says: &'static str) -> Requirement {
    Requirement { test, quantity, says }
}

/// All requirements on the page docs/dev/verification.md, in its order.
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
        "X-FEM: the history of closed, sliding straight and kinked cracks does not depend on it either.",
    ),
    requirement(
        "xfem::shifted_mesh::by_fractions_of_an_element",
        "",
        "X-FEM: K does not change when the mesh is shifted by fractions of an element, down to 1e-9 of it.",
    ),
    requirement(
        "xfem::random_cracks::agree_with_dislocations",
        "",
        "X-FEM: K of 1000 random cracks, many through nodes, along edges or leaving slivers, agrees with the other engine.",
    ),
    requirement(
        "xfem::random_cracks::agree_with_dislocations",
        "condition",
        "X-FEM: the scaled condition number of C stays bounded over these cracks.",
    ),
    requirement(
        "xfem::random_cracks::through_nodes_and_along_lines",
        "",
        "X-FEM: K of cracks exactly through nodes and along mesh lines agrees with the other engine.",
    ),
    requirement("xfem::engines::same_response", "", "Engines: jumps and K agree under smooth tractions."),
    requirement(
        "xfem::histories::reference_cases",
        "",
        "X-FEM: the histories of Table 1 and Fig. 13 agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::angles",
        "",
        "X-FEM: histories of cracks at 30° to 165° agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::crack_face_friction",
        "",
        "X-FEM: histories for crack-face friction of 0 to 0.8 agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::wheel_rail_friction",
        "",
        "X-FEM: histories for wheel–rail friction of −0.4 to 0.4 agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::kinks_of_a_third_of_the_crack",
        "",
        "X-FEM: histories for kinks of ±30° and −60° agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::short_kinks",
        "",
        "X-FEM: histories for kinks of ±60° and 0.3 mm agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::residual_profile",
        "",
        "X-FEM: the history with a residual stress profile agrees with an independent one at every position.",
    ),
    requirement(
        "xfem::histories::pair",
        "",
        "X-FEM: the histories of two cracks that lean apart agree with independent ones at every position.",
    ),
    requirement(
        "xfem::histories::reference_cases",
        "closed tip",
        "X-FEM: K_I of a closed tip vanishes, over the peak of |K_II|, in Table 1 and Fig. 13.",
    ),
    requirement(
        "xfem::histories::wheel_rail_friction",
        "closed tip",
        "X-FEM: K_I of a closed tip vanishes for wheel–rail friction of −0.4 to 0.4.",
    ),
    requirement(
        "xfem::histories::angles",
        "overlap",
        "X-FEM: crack faces do not overlap, relative to the largest opening.",
    ),
    requirement(
        "xfem::contact_pressure::no_oscillation_under_the_wheel",
        "",
        "X-FEM: the contact pressure does not oscillate from face point to face point.",
    ),
    requirement(
        "xfem::clamped_block::table1",
        "",
        "X-FEM: the history of Table 1 in the clamped block agrees with a conforming model at every position.",
    ),
    requirement("xfem::symmetry::mirrored_passage", "", "X-FEM: a mirrored case has the mirrored history."),
    requirement("xfem::symmetry::far_apart", "", "X-FEM: a second crack 20 lengths away has no effect."),
    requirement(
        "engine_paths::reference_case",
        "",
        "Engines: crack paths agree over the 25 increments of Table 1 (mm).",
    ),
    requirement(
        "engine_paths::branch_downwards",
        "",
        "Engines: crack paths agree where the crack branches downwards (mm).",
    ),
    requirement(
        "engine_paths::steep_cracks",
        "",
        "Engines: crack paths agree for cracks at 45° and 60° (mm).",
    ),
    requirement(
        "edge_crack_in_tension::factors_by_angle",
        "",
        "Dislocations: a surface crack in tension has the K of the closed forms.",
    ),
    requirement(
        "edge_crack_in_tension::mirrored",
        "",
        "Dislocations: a mirrored surface crack has the mirrored K.",
    ),
    requirement(
        "section::edge_crack_in_a_strip",
        "",
        "Section: an edge crack in a strip of finite height has the published K_I in tension and bending, to 0.6 of the height.",
    ),
    requirement(
        "section::edge_crack_in_a_rail",
        "",
        "Section: an edge crack in the head of a 60E1, free and on its foundation, has the K_I of plane finite elements with the thickness of head, web and foot.",
    ),
    requirement(
        "section::layers_of_one_width_are_a_strip",
        "",
        "Section: a strip made of layers of one width is that strip, for a straight and a kinked crack.",
    ),
    requirement(
        "section::shallow_cracks_are_in_a_half_plane",
        "",
        "Section: the change of K of a shallow crack falls with the square of its depth.",
    ),
    requirement(
        "section::energy_release_is_that_of_the_sifs",
        "",
        "Section: (K_I² + K_II²)(1 − ν²)/E is the derivative of the work of the faces, for a slant crack to 26 mm of depth.",
    ),
    requirement(
        "section::engines_agree",
        "",
        "Section: both engines give a kinked crack in a rail the same K.",
    ),
    requirement(
        "section::body_is_symmetric_and_definite",
        "",
        "Section: A is symmetric and C its inverse, for two cracks.",
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
        "Dislocations: cracks a thousand lengths apart do not interact.",
    ),
    requirement(
        "half_plane_histories::reference_cases",
        "",
        "Dislocations: the histories of Table 1 and Fig. 13 agree with independent ones at every position.",
    ),
    requirement(
        "half_plane_histories::angles",
        "",
        "Dislocations: histories of cracks at 30° to 165° agree with independent ones at every position.",
    ),
    requirement(
        "half_plane_histories::crack_face_friction",
        "",
        "Dislocations: histories for crack-face friction of 0 to 0.8 agree with independent ones at every position.",
    ),
    requirement(
        "half_plane_histories::wheel_rail_friction",
        "",
        "Dislocations: histories for wheel–rail friction of −0.4 to 0.4 agree with independent ones at every position.",
    ),
    requirement(
        "closed_tip::closed_tips_have_no_opening_mode",
        "",
        "Dislocations: K_I of closed tips vanishes, and the contact conditions hold.",
    ),
    requirement(
        "latin_and_newton::straight_cracks",
        "",
        "LATIN and Newton give the same tractions and K in the same load steps.",
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
    requirement(
        "junctions::surface_crack_in_two_pieces",
        "",
        "Dislocations: a surface crack in two joined pieces has the K of one piece.",
    ),
    requirement(
        "junctions::surface_crack_in_two_pieces_under_the_wheel",
        "",
        "Dislocations: a closed, slipping surface crack in two pieces has the K of one piece under the wheel.",
    ),
    requirement(
        "junctions::branched_cracks",
        "",
        "Dislocations: line, cross, star and an unsymmetric branch have the K of an independent computation.",
    ),
    requirement(
        "junctions::junction_conserves_tractions",
        "",
        "Dislocations: a junction neither loses tractions nor counts them twice.",
    ),
    requirement(
        "junctions::closed_sticking_branch_has_no_effect",
        "",
        "Dislocations: a closed branch that sticks has no effect.",
    ),
    requirement(
        "junctions::energy_is_continuous_at_the_junction",
        "",
        "Dislocations: the energy is continuous when a tip approaches a free crack and joins it.",
    ),
    requirement(
        "junctions::energy_release_rate_of_an_approaching_tip",
        "",
        "Dislocations: the energy release rate of a tip that approaches a free crack is that of its K.",
    ),
    requirement(
        "junctions::mirrored_junctions",
        "",
        "Dislocations: mirrored joined cracks have the mirrored history.",
    ),
    requirement(
        "junction_run::against_a_finer_mesh",
        "",
        "Dislocations: K after coalescence under the wheel agrees with four times the elements.",
    ),
    requirement(
        "junction_run::area_of_the_spall",
        "",
        "Dislocations: the spall of the junction case has the area of a run with twice the elements.",
    ),
    requirement("mirror::passage", "", "Dislocations: a mirrored case has the mirrored history."),
    requirement(
        "plastic_stress::engines_agree",
        "",
        "Engines: K agrees for a crack in layers of balanced stress, and of plastic stress that is balanced on the mesh first.",
    ),
    requirement(
        "plastic_stress::rolled_rail_balances_to_its_own_residual_stress",
        "stress",
        "Plastic stress: that of a rolled rail, projected and balanced on the mesh of the crack, gives its residual stress.",
    ),
    requirement(
        "plastic_stress::rolled_rail_balances_to_its_own_residual_stress",
        "norm",
        "Plastic stress: recovery from cells to nodes preserves the norm.",
    ),
    requirement(
        "step_tolerance::fixed_steps_lock_too_little_slip",
        "",
        "Load steps: fixed ones of 0.1 a, 0.05 a and 0.02 a have the errors of two independent codes with such steps.",
    ),
    requirement(
        "xfem::junctions::a_crack_in_two_pieces_equals_the_whole",
        "",
        "X-FEM: a crack in two joined pieces has the K of one piece, open and under the wheel.",
    ),
    requirement(
        "xfem::junctions::a_t_junction_agrees_with_the_other_engine",
        "",
        "Engines: K of a T-junction agrees, open, closed with friction and without.",
    ),
    requirement(
        "xfem::junctions::tractions_are_conserved",
        "",
        "X-FEM: a junction neither loses tractions nor counts them twice.",
    ),
    requirement(
        "xfem::junctions::mirrored_junctions",
        "",
        "X-FEM: mirrored joined cracks have the mirrored history.",
    ),
    requirement(
        "xfem::neighbours::tips_near_others_and_the_surface",
        "",
        "Engines: K of tips near other cracks and near the surface agrees.",
    ),
    requirement(
        "xfem::neighbours::several_cracks_in_one_element",
        "",
        "Engines: K of cracks that pass through the same elements agrees.",
    ),
    requirement(
        "xfem::neighbours::domains_over_a_neighbour",
        "",
        "X-FEM: K does not depend on whether the domain of integration contains a neighbour.",
    ),
    requirement(
        "xfem::networks::squat_pair",
        "",
        "Engines: K of each crack of a squat agrees, relative to its own peak, also after growth.",
    ),
    requirement(
        "xfem::networks::nine_parallel_cracks",
        "",
        "Engines: K of each of nine parallel cracks agrees.",
    ),
    requirement(
        "xfem::networks::nine_parallel_cracks_of_a_run",
        "",
        "Engines: K of each of nine cracks of a run agrees at every position.",
    ),
    requirement(
        "xfem::networks::k_of_a_sticking_tip_is_constant",
        "",
        "X-FEM: K of a sticking tip is constant, and does not jump when the tip begins to slip.",
    ),
    requirement(
        "slow_tips::k_of_the_slow_tip_of_a_squat",
        "",
        "X-FEM: K of a tip that is much slower than another is resolved along its path, behind a kink of 76°.",
    ),
    requirement(
        "slow_tips::resumed_while_growth_is_deferred",
        "",
        "Engines: growth of a slow tip is deferred until it is a whole increment, and the tips agree (mm).",
    ),
    requirement(
        "xfem::unlike_lengths::a_short_crack_beside_a_long_one",
        "",
        "Engines: K of a short crack beside a long one agrees, relative to its own peak.",
    ),
    requirement(
        "xfem::unlike_lengths::unit_of_length",
        "",
        "X-FEM: C and K do not depend on the unit of length.",
    ),
    requirement(
        "xfem::short_increments::increments_of_a_run",
        "",
        "Engines: K of tips agrees 4 % of the crack length behind a kink.",
    ),
    requirement(
        "xfem::short_increments::small_kinks_of_slow_tips",
        "",
        "Engines: K of tips agrees roughly less than an element behind a kink.",
    ),
    requirement(
        "far_apart::twenty_lengths_away",
        "",
        "Dislocations: a crack 20 lengths away changes K by less than 1 %.",
    ),
    requirement(
        "latin_and_newton::junction_of_cracks",
        "",
        "Contact: LATIN and Newton agree on joined cracks, in both engines.",
    ),
    requirement("junction_run::by_finite_elements", "", "Engines: the spall of the junction case agrees."),
    requirement(
        "loads::partial_slip_is_no_sliding",
        "",
        "Carter: K_I and K_II of the crack of Table 1 agree with those of a prototype, in partial slip and in full sliding.",
    ),
    requirement(
        "loads::full_traction_is_sliding_and_none_is_pressure",
        "",
        "Carter: full traction has the history of full sliding, none that of pressure alone.",
    ),
    requirement(
        "rolling::forces_on_a_coarse_grid",
        "",
        "Rolling contact: forces of the fast theories agree with 855 outputs of CONTACT on a coarse grid.",
    ),
    requirement(
        "rolling::forces_on_a_fine_grid",
        "",
        "Rolling contact: they agree with its 32 outputs on finer grids.",
    ),
    requirement(
        "loads::mirrored_travel",
        "",
        "Carter: mirrored crack, shear and travel have the mirrored history.",
    ),
    requirement(
        "loads::a_table_of_carter_is_carter",
        "",
        "Contact tables: 100 rows have the history of the closed form, and more rows a closer one.",
    ),
    requirement(
        "loads::engines_agree_on_every_kind_of_contact",
        "",
        "Engines: histories agree for partial slip, a contact table and two contacts.",
    ),
    requirement(
        "loads::engines_agree_on_bending_and_cold",
        "",
        "Engines: histories agree for bending on the track and a cold rail.",
    ),
    requirement(
        "loads::the_largest_opening_is_far_from_the_wheel",
        "",
        "Bending: the largest K_I, and where the wheel then is, agree with those of a prototype.",
    ),
    requirement(
        "loads::six_half_widths_away_the_shear_of_the_contact_decides",
        "",
        "Bending: six half-widths from the wheel, K_I of an open crack is linear in the shear of the contact.",
    ),
    requirement(
        "loads::ranges_count_from_the_state_between_passages",
        "",
        "Temperature: K_I between passages is that of the edge crack in tension.",
    ),
    requirement(
        "loads::edge_crack_in_bending",
        "",
        "Bending: K_I of an edge crack in a linear stress is that of the closed form.",
    ),
    requirement(
        "loads::a_winter_rail_breaks",
        "",
        "Fracture: a run ends within an increment of the toughness.",
    ),
    requirement(
        "junction_run::ranges_between_output_positions",
        "",
        "Histories of K: the largest K_I does not depend on the number of output positions.",
    ),
    requirement(
        "xfem::random_networks::engines_agree_or_warn",
        "",
        "Engines: K of random networks, kinked and buried cracks among them, agrees where no warning is given.",
    ),
    requirement(
        "xfem::random_networks::engines_agree_or_warn",
        "K_I",
        "Engines: K_I of each tip of these networks agrees, relative to its own largest value, where no warning is given.",
    ),
    requirement(
        "xfem::random_networks::engines_agree_on_four_kinked_cracks",
        "K_I",
        "Engines: K_I of each tip of four kinked cracks agrees, relative to its own largest value.",
    ),
    requirement(
        "xfem::random_networks::engines_agree_on_four_kinked_cracks",
        "",
        "Engines: K of each of four kinked cracks with little friction agrees.",
    ),
    requirement(
        "awkward_places::a_tip_beside_another_crack",
        "",
        "Dislocations: a tip at half a hundredth of its crack from another crack has the K of three times the elements.",
    ),
    requirement(
        "awkward_places::a_tip_just_below_the_surface",
        "",
        "Dislocations: a tip 0.001 mm below the surface has the K of four times the elements.",
    ),
    requirement(
        "awkward_places::thin_flaps",
        "",
        "Dislocations: a crack at 2° has the K of twice the elements; at 1° a remark says how far it is known.",
    ),
    requirement(
        "awkward_places::cracks_close_beside_each_other",
        "",
        "Dislocations: cracks at a fifth of an element from each other have the K of twice the elements.",
    ),
    requirement(
        "awkward_places::nine_parallel_cracks",
        "",
        "Dislocations: nine parallel cracks have the K of nearly twice the elements.",
    ),
    requirement(
        "space::kernel::triangular_dislocations",
        "",
        "Space: the strain of a jump in full space and half-space is that of an independent package.",
    ),
    requirement(
        "space::fronts::penny_in_tension",
        "",
        "Space: a penny in tension has the K_I of the closed form at every front point.",
    ),
    requirement("space::fronts::penny_converges", "", "Space: K of a penny converges with the cells."),
    requirement(
        "space::fronts::penny_in_shear",
        "",
        "Space: a penny in shear has the K_II and K_III of the closed form at every front point.",
    ),
    requirement(
        "space::fronts::ellipses_in_tension",
        "",
        "Space: flat elliptical cracks in tension have the K_I of the closed form at every front point.",
    ),
    requirement(
        "space::fronts::pennies_with_wavy_fronts_in_tension",
        "",
        "Space: dK_I/dε of pennies with the fronts 1 + ε cos nφ, n = 1 to 4, is that of the first-order solution.",
    ),
    requirement(
        "space::fronts::vertical_semi_ellipses_in_tension",
        "",
        "Space: semi-ellipses that break the surface have the published K_I, away from the surface.",
    ),
    requirement(
        "space::fronts::vertical_semicircle_in_shear",
        "",
        "Space: a vertical semicircle in shear has the K_II and K_III of an independent discretisation.",
    ),
    requirement(
        "space::stiffness::shallow_cracks_stay_definite_on_finer_grids",
        "",
        "Space: the stiffness of a crack at 15° stays as positive definite, next to that at 90°, on finer grids.",
    ),
    requirement("space::stiffness::mirror_images", "", "Space: cracks at 30° and 150° are mirror images."),
    requirement(
        "space::several::pennies_load_each_other_as_dipoles",
        "",
        "Space: pennies at a distance, in one plane or not, load each other as the dipoles of their openings.",
    ),
    requirement(
        "space::several::mirrored_turned_and_exchanged",
        "",
        "Space: two cracks mirrored across the rail have mirrored K, turned ones the same, in any order.",
    ),
    requirement(
        "space::several::distant_cracks_are_single",
        "",
        "Space: cracks far apart have the K of single ones.",
    ),
    requirement(
        "space::several::each_crack_has_its_own_friction",
        "",
        "Space: each crack slides by its own coefficient of friction.",
    ),
    requirement(
        "space::several::wide_parallel_cracks_shield_each_other_as_in_the_plane",
        "",
        "Space: the middles of two wide parallel cracks shield each other as in the 2D engine.",
    ),
    requirement(
        "space::contact::closed_penny_with_friction",
        "",
        "Space: a closed penny slides under τ − μ p and is held by friction when the load falls.",
    ),
    requirement(
        "space::contact::open_faces_do_not_feel_the_contact",
        "",
        "Space: faces that stay open respond linearly.",
    ),
    requirement(
        "space::contact::passages_are_steps_one_by_one",
        "",
        "Space: a passage with lagged factors and guesses is that of single steps.",
    ),
    requirement(
        "space::wheel::compatible_under_pressure_and_shear",
        "",
        "Space: the stress under an elliptical contact is compatible.",
    ),
    requirement(
        "space::wheel::of_point_forces_under_the_contact",
        "",
        "Space: the stress under an elliptical contact is that of its point forces.",
    ),
    requirement(
        "space::contact::lateral_mirror_images",
        "",
        "Space: wheels on either side of the crack give mirrored histories.",
    ),
    requirement(
        "space::track::wide_crack_in_bending_alone",
        "",
        "Space: K of a wide crack under the bending of the rail alone is that of the handbook.",
    ),
    requirement(
        "space::track::loads_of_an_open_crack_add",
        "",
        "Space: wheel, bending and constant stress add up to K of an open crack at all positions.",
    ),
    requirement(
        "space::track::wide_crack_under_axles_of_a_cold_rail",
        "",
        "Space: a wide crack on a cold rail that bends under two axles has the history of the 2D engine.",
    ),
    requirement(
        "space::strike::a_crack_along_the_rail_is_the_case_turned",
        "",
        "Space: a crack along the rail is one across it with the load turned.",
    ),
    requirement(
        "space::strike::cracks_turned_to_either_side_are_mirror_images",
        "",
        "Space: strikes to either side are mirror images.",
    ),
    requirement(
        "space::strike::half_a_turn_leans_the_other_way",
        "",
        "Space: half a turn is the crack that leans the other way.",
    ),
    requirement(
        "space::strike::everything_turned_under_a_round_contact",
        "",
        "Space: crack and round contact turned together have the same K.",
    ),
    requirement(
        "space::vertex::published_exponents_in_full",
        "",
        "Space: next to the surface K has the published exponents of the vertex.",
    ),
    requirement(
        "space::vertex::two_rows_next_to_the_surface_resolve_the_front_from_4_degrees_on",
        "",
        "Space: two further rows next to the surface resolve K from 4° on.",
    ),
    requirement(
        "space::wide::of_the_2d_engine_at_30_degrees",
        "",
        "Space: the middle of a wide crack at 30° has the K_II history of the 2D engine.",
    ),
    requirement(
        "space::wide::of_the_2d_engine_at_15_degrees",
        "",
        "Space: the middle of a wide crack at 15° has the K_II history of the 2D engine.",
    ),
    requirement(
        "space::wide::of_the_2d_engine_under_a_wide_ellipse_at_30_degrees",
        "",
        "Space: a wide crack at 30° under a wide ellipse has the K_II history of the 2D engine under its stress.",
    ),
    requirement(
        "space::wide::of_the_2d_engine_under_a_wide_ellipse_at_15_degrees",
        "",
        "Space: a wide crack at 15° under a wide ellipse has the K_II history of the 2D engine under its stress.",
    ),
    requirement(
        "space::wide::of_the_2d_engine_under_a_mix_with_wear",
        "",
        "Space: the middle of a wide crack under a mix of wheels with wear has the rate and the shares of the 2D engine.",
    ),
    requirement(
        "cycles::of_second_order_along_a_straight_path",
        "",
        "Load cycles of a straight crack converge to second order in the increment.",
    ),
    requirement(
        "path::lives_and_tips_are_those_of_small_increments",
        "life",
        "Path: lives at turning lengths of infinity, 0.5 and 0.16 mm are those of small increments.",
    ),
    requirement(
        "path::lives_and_tips_are_those_of_small_increments",
        "tip",
        "Path: tips at these turning lengths are those of small increments (mm).",
    ),
    requirement(
        "path::engines_follow_the_same_path",
        "tip",
        "Path: both engines lead to the same tip at the default turning length (mm).",
    ),
    requirement(
        "path::engines_follow_the_same_path",
        "life",
        "Path: both engines give the same life at the default turning length.",
    ),
    requirement(
        "path::the_life_converges_where_the_path_turns",
        "",
        "Path: the life along a turning path converges to second order in the increment.",
    ),
    requirement(
        "path::the_limit_path_has_one_life",
        "",
        "Path: the life on the limit path does not depend on the increment.",
    ),
    requirement(
        "path::fracture_is_located",
        "",
        "Path: fracture of a cold rail comes after the same cycles whatever the increment.",
    ),
    requirement(
        "fluid::pressure_and_volume_of_open_cracks",
        "",
        "Fluid: a unit pressure gives the K_I and the volume of edge and buried cracks in closed form, in both engines.",
    ),
    requirement(
        "fluid::pressure_from_the_mouth_adds_to_an_open_crack",
        "",
        "Fluid: the pressure from the mouth is superposed on an open crack.",
    ),
    requirement(
        "fluid::pressure_from_the_mouth_in_both_engines",
        "",
        "Fluid: histories with pressure from the mouth agree between the engines.",
    ),
    requirement(
        "fluid::a_sealed_crack_keeps_its_volume",
        "",
        "Fluid: a sealed crack has the pressure of its closed form under changing tension, compressible or not.",
    ),
    requirement(
        "fluid::a_leaking_crack_keeps_what_is_left",
        "",
        "Fluid: a leaking crack has the pressure of its closed form, and none once it is empty.",
    ),
    requirement(
        "fluid::trapped_fluid_in_both_engines_and_by_both_solvers",
        "",
        "Fluid: histories with trapped fluid, leaking or not, agree between the engines and between the contact solvers.",
    ),
    requirement(
        "fluid::one_pocket_in_joined_cracks",
        "",
        "Fluid: a crack in two joined pieces has the history of that in one, with one pocket.",
    ),
    requirement(
        "fluid::closed_faces_hold_no_fluid",
        "",
        "Fluid: a kinked crack that is closed as the wheel comes has the history of a dry one.",
    ),
    requirement(
        "fluid::cracks_with_and_without_fluid",
        "",
        "Fluid: cracks far apart have pockets of their own, and a dry one beside a wet one stays dry.",
    ),
    requirement(
        "fluid::a_leak_by_small_fixed_steps",
        "",
        "Fluid: leaks agree with those of small fixed load steps.",
    ),
    requirement("fluid::mirrored_travel", "", "Fluid: a mirrored case has the mirrored history."),
    requirement(
        "fluid::trapped_fluid_does_not_feel_the_modulus_of_the_steel",
        "",
        "Fluid: with an incompressible fluid K and pressure do not depend on E.",
    ),
    requirement(
        "space::uncoupled_gap::wide_cracks_have_that_of_the_plane",
        "",
        "Coupled wheel: the gap that the contact of the space engine leaves over a wide crack tends to that in the plane.",
    ),
    requirement(
        "coupled_wheel::a_symmetric_crack_is_not_felt",
        "",
        "Coupled wheel: over a vertical crack below its middle a frictionless wheel has the Hertzian pressure, K = 0 and no further approach.",
    ),
    requirement(
        "coupled_wheel::faces_that_stick_are_not_felt",
        "",
        "Coupled wheel: over faces that stick (friction 10) the pressure is that on the uncracked rail, K = 0 and the wheel approaches no further.",
    ),
    requirement(
        "coupled_wheel::load_on_the_lips_converges",
        "",
        "Coupled wheel: the load on the lips of a mouth converges with the number of surface nodes, whose largest pressure does not.",
    ),
    requirement(
        "coupled_wheel::frictionless_cracks",
        "",
        "Coupled wheel: K_II of frictionless cracks at 15° to 90° agrees with that of a prototype.",
    ),
    requirement(
        "coupled_wheel::approach_and_energy_release",
        "",
        "Coupled wheel: at every load the approach grows with the crack length as the energy release rate grows with the load (Maxwell).",
    ),
    requirement(
        "coupled_wheel::stiffer_steel",
        "",
        "Coupled wheel: with twice E at given pressure and half-width K is the same and the approach half as large.",
    ),
    requirement(
        "coupled_wheel::stiffer_steel_over_a_passage",
        "",
        "Coupled wheel: over a passage with friction, partial slip or water twice E leaves K and the pressures as they are and halves the approach.",
    ),
    requirement(
        "coupled_wheel::history_with_friction",
        "",
        "Coupled wheel: the extremes of K over a passage with friction agree with those of a prototype, and the coupling begins without a jump of K.",
    ),
    requirement(
        "coupled_wheel::engines_and_solvers",
        "",
        "Coupled wheel: histories agree between the engines and between the contact solvers.",
    ),
    requirement(
        "coupled_wheel::partial_slip_of_the_wheel",
        "",
        "Coupled wheel: partial slip agrees with a prototype, between the engines and the contact solvers, and tends to full sliding.",
    ),
    requirement(
        "coupled_wheel::mirrored_travel",
        "",
        "Coupled wheel: a mirrored pair of cracks has the mirrored history, in full sliding, in partial slip and with water.",
    ),
    requirement(
        "coupled_wheel::water_under_a_wheel_that_bridges_the_mouth",
        "",
        "Coupled wheel: K_I under linear and constant pressure from the mouth agrees with that of prototypes, and histories with all fluids between the engines and the contact solvers.",
    ),
];
