#define DOCTEST_CONFIG_IMPLEMENT
#include "tests/support/skipped.h"

int main(int argc, char** argv)
{
    constexpr int skipped = 77;
    const int status = doctest::Context(argc, argv).run();
    return status == 0 && seamflow::test::n_skipped > 0 ? skipped : status;
}
