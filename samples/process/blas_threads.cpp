#include "samples/process/blas_threads.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "solvers/platform/address_space.h"

namespace seamflow {

void do_without_blas_threads_where_limited()
{
    constexpr const char* variable = "OPENBLAS_NUM_THREADS";
    if (!limit_of_address_space() || std::getenv(variable) != nullptr)
        return;
    std::vector<std::string> words;
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    for (std::string word; std::getline(file, word, '\0');)
        words.push_back(word);
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    // If it cannot be restarted, it continues as it is.
    if (!words.empty() && ::setenv(variable, "1", 1) == 0)
        ::execv("/proc/self/exe", pointers.data());
}

}  // namespace seamflow
