#include "hal/teensy40/board.hpp"
#include "tests/target/images/puppet_program.hpp"

int main() { astro::target::run_puppet<astro::teensy40::Board>(); }
