// The main function of smooth, compare, generate and inspect (see programs.h).

#include "samples/programs.h"

int main(int argc, char** argv)
{
    return seamflow::run_program(SEAMFLOW_PROGRAM, argc, argv);
}
