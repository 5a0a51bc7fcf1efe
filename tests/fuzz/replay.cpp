// Runs a harness once for each of the files named, where there is no libFuzzer: FILE…
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n_bytes);

int main(int n, char** files)
{
    for (int i = 1; i < n; ++i) {
        std::ifstream file(files[i], std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        if (!file) {
            std::fprintf(stderr, "%s cannot be read\n", files[i]);
            return 1;
        }
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
    }
    std::printf("%d files\n", n - 1);
    return n > 1 ? 0 : 1;
}
