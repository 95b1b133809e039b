//! Every example of a user, run to its end: each asserts a number.

macro_rules! examples {
    ($($name:ident: $path:literal),* $(,)?) => {$(
        #[path = $path]
        mod $name;

        #[test]
        fn $name() {
            $name::main().unwrap();
        }
    )*};
}

examples! {
    one_passage: "../examples/one_passage.rs",
    growth_loop: "../examples/growth_loop.rs",
    network: "../examples/network.rs",
    own_stress_field: "../examples/own_stress_field.rs",
    own_criterion: "../examples/own_criterion.rs",
}
