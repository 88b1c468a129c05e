//! Prints the parameter tables of all methods, as their pages have them: `cargo run -p noisefloor-registry --example tables`.

fn main() {
    for factory in noisefloor_registry::builtin().iter().chain(&noisefloor_registry::guests()) {
        println!("## {}\n\n{}", factory.id(), noisefloor_registry::params_table(factory.params()));
    }
}
