#include "engine/ranks/communicator.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

enum Tag : int { CollectiveTag, ArrivalTag, EndTag };

/// Thrown where a rank waits, because another rank has failed.
class Interruption : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The time to wait for a message before checking for other events.
constexpr std::chrono::milliseconds patience_of_wait{100};

using Kind = WorkOutcome::Kind;

/// Calls work().
/// @returns how it ended: Done, or the kind and the message of its exception.
template <class Work>
WorkOutcome outcome_of(Work&& work)
{
    try {
        work();
        return {};
    } catch (const Interruption& error) {
        return {Kind::Interrupted, error.what()};
    } catch (const InputError& error) {
        return {Kind::InputError, error.wording().text};
    } catch (const OptionError& error) {
        return {Kind::OptionError, error.wording().text};
    } catch (const ComputationError& error) {
        return {Kind::ComputationError, error.what()};
    } catch (const OutputError& error) {
        return {Kind::OutputError, error.what()};
    } catch (const Cancelled& error) {
        return {Kind::Cancelled, error.what()};
    } catch (const std::bad_alloc&) {
        return {Kind::OutOfMemory};
    } catch (const std::exception& error) {
        return {Kind::Failure, error.what()};
    } catch (...) {
        return {Kind::Failure, "failed for an unknown reason"};
    }
}

/// Throws the exception of a failed outcome.
[[noreturn]] void throw_as(Kind kind, const std::string& message)
{
    switch (kind) {
    case Kind::InputError:
        throw InputError(Wording{message});
    case Kind::OptionError:
        throw OptionError(Wording{message});
    case Kind::OutputError:
        throw OutputError(message);
    case Kind::Cancelled:
        throw Cancelled(message);
    case Kind::OutOfMemory:
        throw std::bad_alloc();
    default:
        throw ComputationError(message);
    }
}

/// Throws the error of the ranks that have failed, if any has.
/// @param outcomes of all ranks.
void require_success(const std::vector<WorkOutcome>& outcomes)
{
    const auto has_failed = [](const WorkOutcome& outcome) {
        return outcome.kind != Kind::Done && outcome.kind != Kind::Interrupted;
    };
    const auto first = std::ranges::find_if(outcomes, has_failed);
    if (first == outcomes.end())
        return;
    const bool alike = std::ranges::all_of(outcomes, [&](const WorkOutcome& outcome) {
        return outcome.kind == first->kind && outcome.message == first->message;
    });
    if (first->kind == Kind::OutOfMemory)
        throw ComputationError(
            fmt::format("rank {} on {}: there is not enough memory: use more ranks, on more machines",
                        first - outcomes.begin(), first->host));
    throw_as(first->kind,
             alike ? first->message
                   : fmt::format("rank {} on {}: {}", first - outcomes.begin(), first->host, first->message));
}

Bytes packed_outcome(const WorkOutcome& outcome)
{
    Packer packer;
    packer.put(outcome.kind);
    packer.put_all(std::span<const char>(outcome.message));
    packer.put_all(std::span<const char>(outcome.host));
    return packer.take();
}

std::string text_from(Unpacker& unpacker)
{
    const auto letters = unpacker.get_all<char>();
    return {letters.begin(), letters.end()};
}

WorkOutcome unpacked_outcome(const Bytes& bytes)
{
    Unpacker unpacker(bytes);
    WorkOutcome outcome;
    outcome.kind = unpacker.get<Kind>();
    outcome.message = text_from(unpacker);
    outcome.host = text_from(unpacker);
    return outcome;
}

}  // namespace

Communicator::Communicator(Transport& transport)
    : transport_(&transport)
{
    retry([&] {
        collective_.resize(transport.size());
        ended_.resize(transport.size());
    });
}

void Communicator::send(int to, int tag, Bytes bytes)
{
    ++n_messages_;
    n_bytes_ += bytes.size();
    transport_->send(to, tag, std::move(bytes));
}

void Communicator::send(int to, Bytes bytes)
{
    send(to, ArrivalTag, std::move(bytes));
}

/// Waits for the next message and puts it into the list that it belongs to.
/// @returns whether a message arrived in time.
bool Communicator::take_in(std::chrono::microseconds patience)
{
    std::optional<Message> message = transport_->receive(patience);
    if (!message)
        return false;
    sort_in(std::move(*message));
    return true;
}

/// Puts a message into the list of its tag; the message of an end becomes an outcome.
void Communicator::sort_in(Message message)
{
    switch (message.tag) {
    case CollectiveTag:
        collective_[message.from].push_back(std::move(message.bytes));
        break;
    case ArrivalTag:
        arrivals_.push_back(std::move(message));
        break;
    default:
        ended_[message.from] = unpacked_outcome(message.bytes);
    }
}

/// @throws Interruption if the work of another rank has ended without success.
void Communicator::require_all_well() const
{
    for (const auto& outcome : ended_)
        if (outcome && outcome->kind != Kind::Done)
            throw Interruption(outcome->message);
}

void Communicator::give(int to, Bytes bytes)
{
    send(to, CollectiveTag, std::move(bytes));
}

Bytes Communicator::take(int from)
{
    while (collective_[from].empty()) {
        require_all_well();
        if (ended_[from])
            throw std::logic_error(fmt::format("rank {} has ended too early", from));
        take_in(patience_of_wait);
    }
    Bytes bytes = std::move(collective_[from].front());
    collective_[from].pop_front();
    return bytes;
}

std::vector<Bytes> Communicator::exchange(std::span<const int> others, std::vector<Bytes> to_each)
{
    for (std::size_t i = 0; i < others.size(); ++i)
        give(others[i], std::move(to_each[i]));
    std::vector<Bytes> from_each;
    for (const int other : others)
        from_each.push_back(take(other));
    return from_each;
}

std::vector<Bytes> Communicator::allgather(Bytes own)
{
    // In each round, every rank passes on its own data and those of the ranks before it; the number of ranks whose data
    // it has doubles.
    std::vector<Bytes> known{std::move(own)};
    const auto after = [&](int n) { return (rank() + n) % size(); };
    for (int n = 1; n < size(); n *= 2) {
        const int n_passed = std::min(n, size() - n);
        Packer packer;
        for (int i = 0; i < n_passed; ++i)
            packer.put_all(std::span<const std::byte>(known[i]));
        give(after(n), packer.take());
        const Bytes received = take(after(size() - n));
        Unpacker unpacker(received);
        for (int i = 0; i < n_passed; ++i)
            known.push_back(unpacker.get_all<std::byte>());
    }
    std::vector<Bytes> of_ranks(size());
    for (int i = 0; i < size(); ++i)
        of_ranks[after(size() - i)] = std::move(known[i]);
    return of_ranks;
}

std::optional<Message> Communicator::next_arrival(std::chrono::microseconds patience)
{
    if (arrivals_.empty())
        take_in(patience);
    require_all_well();
    if (arrivals_.empty())
        return std::nullopt;
    Message message = std::move(arrivals_.front());
    arrivals_.pop_front();
    return message;
}

/// Waits until all ranks have ended the work, and returns their outcomes. Messages still in transit from a rank arrive
/// before its end, and are discarded. Messages after its end belong to the next work, which other ranks may have begun.
std::vector<WorkOutcome> Communicator::exchange_outcomes(const WorkOutcome& own)
{
    for (int r = 0; r < size(); ++r)
        if (r != rank())
            retry([&] { transport_->send(r, EndTag, packed_outcome(own)); });
    retry([&] { ended_[rank()] = own; });
    std::vector<Message> of_next_work;
    while (!std::ranges::all_of(ended_, [](const auto& outcome) { return outcome.has_value(); })) {
        std::optional<Message> message;
        retry([&] { message = transport_->receive(patience_of_wait); });
        if (message && ended_[message->from])
            retry([&] { of_next_work.push_back(std::move(*message)); });
        else if (message && message->tag == EndTag)
            retry([&] { ended_[message->from] = unpacked_outcome(message->bytes); });
    }
    retry([&] { transport_->put_back(of_next_work); });
    std::vector<WorkOutcome> outcomes;
    retry([&] {
        outcomes.clear();
        for (const auto& outcome : ended_)
            outcomes.push_back(*outcome);
    });
    return outcomes;
}

/// Runs the work on this rank, after messages and outcomes of earlier work have been cleared, and throws if any rank
/// has failed.
void Communicator::run_work(const std::function<void()>& work)
{
    for (auto& messages : collective_)
        messages.clear();
    arrivals_.clear();
    std::ranges::fill(ended_, std::nullopt);
    WorkOutcome own = outcome_of(work);
    retry([&] { own.host = transport_->host(); });
    require_success(exchange_outcomes(own));
}

}  // namespace seamflow
