#include "engine/ranks/rank_exchange.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include "partition/index_lists.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The time after which a receiver notices that its run has failed.
constexpr std::chrono::milliseconds patience_of_receiver{20};

/// The header before the rows of a message.
struct Header {
    std::uint64_t run;
    Index sub_mesh;
    MessageKind kind;
};

}  // namespace

RankExchange::RankExchange(Communicator& comm, const DealtMesh& dealt)
    : comm_(&comm)
    , dealt_(&dealt)
    , own_interest_(dealt.known.size())
    , listeners_(dealt.known.size())
{
    for (auto& mail : mail_)
        mail.resize(dealt.known.size());
}

/// The index in DealtMesh::known of a sub-mesh, from its number in the whole mesh.
Index RankExchange::known_index(Index number) const
{
    return static_cast<Index>(std::ranges::lower_bound(dealt_->known, number) - dealt_->known.begin());
}

/// Finds the rows of remote sub-meshes that the transfers to this rank's sub-meshes read, and further rows.
void RankExchange::find_own_interest(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                                     std::span<const std::vector<Index>> further)
{
    const auto add_rows_of = [&](const std::vector<Transfer>& transfers, std::initializer_list<MessageKind> kinds) {
        for (const Transfer& transfer : transfers)
            for (const MessageKind kind : kinds)
                if (is_remote(transfer.from)) {
                    auto& rows = own_interest_[transfer.from].rows[index_of(kind)];
                    rows.insert(rows.end(), transfer.source.begin(), transfer.source.end());
                }
    };
    for (Interest& interest : own_interest_)
        interest.predicts.assign(sweeps.size(), 0);
    for (const auto& halo : decomposition.halo)
        add_rows_of(halo, {MessageKind::Position, MessageKind::Solution});
    for (std::size_t s = 0; s < further.size(); ++s)
        add_rows_of({{.from = static_cast<Index>(s), .to = -1, .source = further[s], .target = {}}},
                    {MessageKind::Position, MessageKind::Solution});
    for (std::size_t sweep = 0; sweep < sweeps.size(); ++sweep)
        for (std::size_t s = 0; s < dealt_->known.size(); ++s) {
            add_rows_of(sweeps[sweep].traces[s], {MessageKind::Solution});
            add_rows_of(sweeps[sweep].predictions[s], {MessageKind::Prediction});
            for (const Transfer& prediction : sweeps[sweep].predictions[s])
                own_interest_[prediction.from].predicts[sweep] = 1;
        }
    for (Interest& interest : own_interest_)
        for (auto& rows : interest.rows)
            sort_unique(rows);
}

void RankExchange::connect(const Decomposition& decomposition, std::span<const SweepPlan> sweeps,
                           std::span<const std::vector<Index>> further)
{
    find_own_interest(decomposition, sweeps, further);
    pending_.resize(sweeps.size());
    std::vector<Packer> per_rank(comm_->size());
    for (std::size_t s = 0; s < dealt_->known.size(); ++s) {
        if (!is_remote(static_cast<Index>(s)))
            continue;
        Packer& packer = per_rank[holder(static_cast<Index>(s))];
        packer.put(dealt_->known[s]);
        for (const auto& rows : own_interest_[s].rows) {
            // As numbers in the whole mesh, because local indices differ between ranks.
            std::vector<Index> numbers;
            for (const Index row : rows)
                numbers.push_back(dealt_->vertex_numbers[decomposition.sub_meshes[s].local_to_global[row]]);
            packer.put_all(std::span<const Index>(numbers));
        }
        packer.put_all(std::span<const std::uint8_t>(own_interest_[s].predicts));
    }
    std::vector<int> others;
    std::vector<Bytes> bytes;
    for (int rank = 0; rank < comm_->size(); ++rank)
        if (rank != comm_->rank()) {
            others.push_back(rank);
            bytes.push_back(per_rank[rank].take());
        }
    const std::vector<Bytes> from_each = comm_->exchange(others, std::move(bytes));
    for (std::size_t i = 0; i < others.size(); ++i)
        for (Unpacker unpacker(from_each[i]); !unpacker.is_at_end();) {
            const Index s = known_index(unpacker.get<Index>());
            Interest& interest = listeners_[s].emplace_back();
            interest.rank = others[i];
            for (auto& rows : interest.rows)
                for (const Index number : unpacker.get_all<Index>())
                    rows.push_back(local_index(decomposition.sub_meshes[s], find_in(dealt_->vertex_numbers, number)));
            interest.predicts = unpacker.get_all<std::uint8_t>();
        }
}

bool RankExchange::awaits(MessageKind kind, std::size_t sweep, Index s) const
{
    return own_interest_[s].includes(kind, sweep);
}

void RankExchange::set_event(MessageKind kind, std::size_t sweep, Index s, TaskGraph::Node event)
{
    pending_[sweep].push_back({kind, s, event, false});
}

void RankExchange::receive(MessageKind kind, Index s, Points& rows)
{
    Bytes& bytes = mail_[index_of(kind)][s];
    const std::byte* from = bytes.data() + sizeof(Header);
    for (const Index row : own_interest_[s].rows[index_of(kind)]) {
        std::memcpy(rows.row(row).data(), from, sizeof(Point));
        from += sizeof(Point);
    }
    bytes = Bytes();
}

void RankExchange::send(MessageKind kind, std::size_t sweep, Index s, const Points& rows)
{
    for (const Interest& interest : listeners_[s]) {
        if (!interest.includes(kind, sweep))
            continue;
        Packer packer;
        packer.reserve(sizeof(Header) + interest.rows[index_of(kind)].size() * sizeof(Point));
        packer.put(Header{run_, dealt_->known[s], kind});
        for (const Index row : interest.rows[index_of(kind)])
            packer.put_row(rows.row(row).data());
        comm_->send(interest.rank, packer.take());
    }
}

/// Starts the task that waits for a message; keeps a message of a later run.
void RankExchange::deliver(Message message, TaskGraph& graph, std::vector<PendingMessage>& pending)
{
    const auto header = Unpacker(message.bytes).get<Header>();
    if (header.run > run_) {
        early_.push_back(std::move(message));
        return;
    }
    const Index s = known_index(header.sub_mesh);
    const auto arrival = std::ranges::find_if(
        pending, [&](const PendingMessage& a) { return a.kind == header.kind && a.sub_mesh == s && !a.has_come; });
    if (header.run < run_ || arrival == pending.end() ||
        message.bytes.size() != sizeof(Header) + own_interest_[s].rows[index_of(header.kind)].size() * sizeof(Point))
        throw std::logic_error("a message came that nobody waits for");
    mail_[index_of(header.kind)][s] = std::move(message.bytes);
    graph.signal(arrival->event);
    arrival->has_come = true;
}

/// Receives all messages of a run. If the run fails, on this rank or another, waiting tasks are started, too: the graph
/// then skips them.
void RankExchange::receive_all(TaskGraph& graph, std::vector<PendingMessage>& pending)
{
    try {
        for (Message& message : std::exchange(early_, {}))
            deliver(std::move(message), graph, pending);
        const auto all_have_come = [&] { return std::ranges::all_of(pending, &PendingMessage::has_come); };
        while (!all_have_come() && !graph.is_ending())
            if (std::optional<Message> message = comm_->next_arrival(patience_of_receiver))
                deliver(std::move(*message), graph, pending);
    } catch (...) {
        graph.fail(std::current_exception());
    }
    for (PendingMessage& arrival : pending)
        if (!arrival.has_come)
            retry([&] { graph.signal(arrival.event); });
}

void RankExchange::run(TaskGraph& graph, std::size_t sweep, const std::function<void()>& begin,
                       const std::function<void()>& join)
{
    ++run_;
    begin();
    std::vector<PendingMessage> pending = pending_[sweep];
    const std::jthread receiver([&] { receive_all(graph, pending); });
    try {
        graph.run(sweep, 0.0, join);
    } catch (...) {
        // Without this failure the receiver would wait for messages that other ranks do not send.
        graph.fail(std::current_exception());
        throw;
    }
}

}  // namespace seamflow
