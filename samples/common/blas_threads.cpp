#include "samples/common/blas_threads.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace seamflow {

void do_without_blas_threads_where_limited()
{
    constexpr const char* variable = "OPENBLAS_NUM_THREADS";
    rlimit limit = {};
    const bool is_limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    if (!is_limited || std::getenv(variable) != nullptr)
        return;
    std::vector<std::string> words;
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    for (std::string word; std::getline(file, word, '\0');)
        words.push_back(word);
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    // Where it cannot be started anew, it goes on as it is.
    if (!words.empty() && ::setenv(variable, "1", 1) == 0)
        ::execv("/proc/self/exe", pointers.data());
}

}  // namespace seamflow
