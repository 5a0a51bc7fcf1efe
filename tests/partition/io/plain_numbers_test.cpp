// Numbers and lines in their commonest form are read as others are.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/formats/obj.h"
#include "partition/formats/obj_scan.h"
#include "partition/io/plain_numbers.h"
#include "partition/io/text_scanner.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/mesh_files.h"

using namespace seamflow;

namespace {

/// So many characters must follow a number.
const std::string padding(8, ' ');

/// Compares with from_chars. @returns whether the number is plain.
bool check_real(const std::string& number)
{
    CAPTURE(number);
    const std::string text = number + padding;
    double value = 0;
    const char* const end = read_plain_real(text.data(), text.data() + text.size(), value);
    if (end == nullptr)
        return false;
    double expected = 0;
    const auto result = std::from_chars(text.data(), end, expected);
    CHECK(result.ec == std::errc());
    CHECK(result.ptr == end);
    CHECK(std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(expected));
    return end == text.data() + number.size();
}

std::string random_digits(RandomNumbers& random, int most)
{
    std::string digits;
    for (int n = random.below(most + 1); n > 0; --n)
        digits += static_cast<char>('0' + random.below(10));
    return digits;
}

std::string random_text(RandomNumbers& random, const std::vector<std::string>& words, int n)
{
    std::string text;
    while (n-- > 0)
        text += words[random.below(static_cast<int>(words.size()))];
    return text;
}

/// The mesh and all messages.
std::string outcome_of_obj(std::string_view text)
{
    FaultLog faults;
    std::string outcome;
    try {
        const PolygonMesh mesh = read_obj("a", text, {}, &faults);
        for (Index i = 0; i < mesh.vertices.size(); ++i)
            outcome += std::to_string(std::bit_cast<std::uint64_t>(mesh.vertices.data()[i])) + " ";
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            outcome += "f ";
            for (const Index v : mesh.face(f))
                outcome += std::to_string(v) + " ";
        }
    } catch (const InputError& error) {
        outcome = error.what();
    }
    for (const std::string& message : faults.messages)
        outcome += message + "\n";
    return outcome;
}

}  // namespace

TEST_CASE("plain numbers: the commonest are plain, others are not")
{
    for (const char* number : {"0", "-0", "1", "-12", "0.5", "0.125", "123456.789", "0.001001001001001001", "1.",
                               "-0.0", "12345678.25", "100000000000000000", "0.000000000000000000000000001"})
        CHECK(check_real(number));
    for (const char* number : {"", "-", ".5", "+1", "--1", "x", "1e5", "nan", "1000000000000000000",
                               "0.0000000000000000000000000001", "1234567890123456789", "123456789.1234567890"})
        CHECK(!check_real(number));
}

TEST_CASE("plain numbers: half way between two doubles, and next to that")
{
    for (const std::string number :
         {"9007199254740993", "9007199254740992", "9007199254740995", "18014398509481986", "4503599627370496.5",
          "4503599627370497.5", "2251799813685248.25", "2251799813685248.75", "1125899906842624.125",
          "9007199254740993.1", "9007199254740992.9", "90071992547409930", "0.90071992547409930"}) {
        check_real(number);
        check_real("-" + number);
    }
}

TEST_CASE("plain numbers: rounded correctly, with any number of digits")
{
    RandomNumbers random(1);
    int n_plain = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const std::string sign = random.below(2) == 0 ? "" : "-";
        n_plain += check_real(sign + random_digits(random, 10) + (random.below(8) > 0 ? "." : "") +
                              std::string(random.below(4), '0') + random_digits(random, 20))
                       ? 1
                       : 0;
        // As many programs write it.
        const double value = random.symmetric() * std::pow(10.0, random.below(6)) + random.unit() * 0x1p-32;
        std::array<char, 64> text{};
        const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
        check_real({text.data(), end.ptr});
    }
    CHECK(n_plain > n / 4);
}

TEST_CASE("plain numbers: nothing behind the end of the text is read")
{
    const std::string digits = "12345678";
    for (std::size_t n = 0; n <= digits.size(); ++n) {
        // Its own memory, so that a sanitizer sees more.
        const std::vector<char> text(digits.begin(), digits.begin() + static_cast<std::ptrdiff_t>(n));
        std::uint64_t number = 0;
        CHECK(read_plain_digits(text.data(), text.data() + n, number) == nullptr);
        double value = 0;
        CHECK(read_plain_real(text.data(), text.data() + n, value) == nullptr);
    }
}

TEST_CASE("plain lines: OBJ with spaces is read as OBJ with tabs, which is never plain")
{
    const std::vector<std::string> words = {"v",
                                            "f",
                                            " ",
                                            " ",
                                            " ",
                                            "  ",
                                            " 1",
                                            " 2",
                                            " 3",
                                            " 4",
                                            " 1/1",
                                            " 2//3",
                                            " 3/",
                                            " 4/5/6",
                                            " 2/1/3/4",
                                            " -1",
                                            " 0",
                                            " 1.5",
                                            " -0.25",
                                            " 1e2",
                                            " 1-2",
                                            " 1.5.5",
                                            " x",
                                            "/",
                                            "#",
                                            "\\",
                                            "\r",
                                            "\t",
                                            "\v",
                                            "\n",
                                            "\n",
                                            "\nv 0.5 1 -2",
                                            "\nf 1 2 3",
                                            "\nf 3 2 1 4",
                                            "\r\n",
                                            "\nf",
                                            "\nv",
                                            " 12345678901234567890",
                                            std::string(1, '\0')};
    RandomNumbers random(2);
    int n_faces = 0;
    for (int i = 0; i < 20'000; ++i) {
        const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + random_text(random, words, random.below(12)) +
                                 (random.below(2) == 0 ? "\n# the end\n" : "");
        std::string tabs = text;
        std::ranges::replace(tabs, ' ', '\t');
        CAPTURE(text);
        const std::string outcome = outcome_of_obj(text);
        CHECK(outcome == outcome_of_obj(tabs));
        n_faces += test::contains(outcome, "f ") ? 1 : 0;
    }
    CHECK(n_faces > 1000);
}

TEST_CASE("plain lines: the first words of lines, whatever follows")
{
    const std::vector<std::string> words = {"v",  "vn", "f",  "#",  "\\", " ",       "\t",     "\r",
                                            "\n", "\n", "\n", " 1", "1",  "\\ \r\n", "# \\\n", std::string(1, '\0')};
    RandomNumbers random(3);
    for (int i = 0; i < 20'000; ++i) {
        const std::string text = random_text(random, words, random.below(16));
        CAPTURE(text);
        for (const TextSyntax syntax : {obj_syntax, TextSyntax{}, TextSyntax{.comment = '\0'}}) {
            TextScanner fast("a", text, syntax);
            TextScanner slow("a", text, syntax);
            while (slow.next_line()) {
                CHECK(fast.next_keyword() == slow.token());
                CHECK(fast.line() == slow.line());
            }
            CHECK(fast.next_keyword().empty());
        }
    }
}
