// The program `footprint`.
#include "app/program.hpp"

int main(int argc, char** argv) { return footprint::run_program(argc, argv); }
