fn main() {
    println!("gonio");
}
