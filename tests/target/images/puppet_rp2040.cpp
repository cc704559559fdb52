#include "hal/rp2040/board.hpp"
#include "tests/target/images/puppet_program.hpp"

int main() { astro::target::run_puppet<astro::rp2040::Board>(); }
