// A program for tests/mutants/maker_test.py: with each of its mutants it prints something else.

#include <array>
#include <cstdio>
#include <type_traits>

namespace {

// Nothing here runs.
using Row = std::array<int, 2 + 6>;
constexpr int three = 1 + 2;
constexpr Row values{5, 11, 2, 17, 3, 29, 7, 13};
static_assert(three == 3 && three > 2);
enum class Kind { First = 1, Second = 1 + 1 };
template <class Value>
concept Small = sizeof(Value) < 3 || sizeof(Value) == 4;

struct Numbers {
    int low : 4;

    int operator[](int i) const { return values[static_cast<unsigned>(i)] + low; }
};

template <Small Value>
int side_of(Value value)
{
    if constexpr (std::is_signed_v<Value> && sizeof(Value) == 4)
        return value < three ? -1 : 1;
    return 9;
}

int difference(int from, int to)
{
    return to - from;
}

void note(int number)
{
    std::printf("%d\n", number);
}

void walk(const Numbers& numbers, double most)
{
    int sum = 0;
    for (int i = 1; i < 3; ++i) {  // a comment // in a line
        sum += numbers[i];
        sum = difference(sum, numbers[i + 1]);
    }
    note(sum);
    const double part = 0.5;
    if (part < most && sum != three)
        note(numbers[three]);
    else
        sum = 43;
    while (sum > three)
        sum -= 40;
    note(difference(sum,  // on two lines
                    three));
}

int number_of(Kind kind)
{
    switch (kind) {
    case Kind::First:
        return 7;
    default:
        break;
    }
    return 8;
}

}  // namespace

int main()
{
    walk(Numbers{1}, 1.0);
    walk(Numbers{three}, 0.25);
    note(side_of(-three));
    note(side_of(three));
    note(side_of(static_cast<short>(three)));
    note(number_of(Kind::First) * 10 + number_of(Kind::Second));
}
