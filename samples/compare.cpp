#include "samples/programs.h"

int main(int argc, char** argv)
{
    return seamflow::run_program("compare", argc, argv);
}
