#include "engine/ranks/rank_group.h"

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/options/flow_control.h"
#include "engine/ranks/communicator.h"
#include "engine/ranks/rank_message.h"
#include "engine/ranks/rank_part.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// The number of ranks on this rank's machine. All ranks call this together.
int count_on_this_machine(Communicator& comm, const Transport& transport)
{
    int n = 0;
    comm.run([&] {
        const std::string host = transport.host();
        for (const Bytes& bytes : comm.allgather(packed(std::vector<char>(host.begin(), host.end())))) {
            const auto other = unpacked<char>(bytes);
            n += std::ranges::equal(other, host) ? 1 : 0;
        }
    });
    return n;
}

/// A flow that rank 0 runs, on another rank.
class ServedFlow {
  public:
    explicit ServedFlow(int threads)
        : workers_(threads)
        , progress_(control_)
    {
    }
    ServedFlow(const ServedFlow&) = delete;
    ServedFlow& operator=(const ServedFlow&) = delete;

    /// Destroyed on the threads on which the members were made, because each thread has memory of its own.
    ~ServedFlow()
    {
        workers_.execute([&] { part_.reset(); });
    }

    /// Makes the RankPart of the flow from a message.
    /// @returns the answer to rank 0.
    Bytes make_part(Communicator& comm, Bytes message)
    {
        workers_.execute([&] {
            Unpacker unpacker(message);
            [[maybe_unused]] const auto header = unpacker.get<RankHeader>();
            DealtMesh dealt = dealt_mesh(unpacker);
            message = Bytes();
            part_.emplace(comm, std::move(dealt), progress_);
        });
        return packed(part_->saved_rows());
    }

    /// Serves a request on the threads of the flow. @returns the answer to rank 0.
    Bytes act(RankTask task, Unpacker& message)
    {
        Bytes answer;
        workers_.execute([&] { answer = part_->act(task, message); });
        return answer;
    }

  private:
    Workers workers_;
    FlowControl control_;
    Progress progress_;
    std::optional<RankPart> part_;
};

/// Serves rank 0 on another rank.
class RankServer {
  public:
    RankServer(Communicator& comm, int threads)
        : comm_(comm)
        , threads_(threads)
    {
    }

    /// Serves one request of rank 0. @returns the exit status, if the request is to end.
    std::optional<int> serve()
    {
        RankHeader header{};
        std::optional<int> status;
        try {
            comm_.run([&] {
                Bytes message = comm_.take(0);
                Unpacker unpacker(message);
                header = unpacker.get<RankHeader>();
                if (header.task == RankTask::Dismiss)
                    status = header.value;
                else if (header.task == RankTask::Drop)
                    flows_.erase(header.flow);
                else if (header.task == RankTask::Deal)
                    begin(header, std::move(message));
                else
                    comm_.give(0, flows_.at(header.flow)->act(header.task, unpacker));
            });
        } catch (const std::exception&) {
            // Rank 0 gets the same exception and reports it. The flow cannot continue.
            flows_.erase(header.flow);
            status.reset();
        }
        return status;
    }

  private:
    /// Begins a flow with its RankPart. Confirms the message to rank 0 at once, so that rank 0 deals one part at a
    /// time.
    void begin(const RankHeader& header, Bytes message)
    {
        comm_.give(0, {});
        const int threads = header.value > 0 ? header.value : threads_;
        auto& flow = flows_[header.flow] = std::make_unique<ServedFlow>(threads);
        comm_.give(0, flow->make_part(comm_, std::move(message)));
    }

    Communicator& comm_;
    int threads_;
    /// By the numbers of the flows.
    std::map<int, std::unique_ptr<ServedFlow>> flows_;
};

}  // namespace

/// Making the communicator is retried if memory is lacking, because other ranks wait for this one.
RankGroup::RankGroup(Transport& transport)
    : comm_(retry([&] { return std::make_unique<Communicator>(transport); }))
    , size_(transport.size())
    , n_on_this_machine_(count_on_this_machine(*comm_, transport))
{
}

RankGroup::~RankGroup()
{
    try {
        if (!has_dismissed_)
            dismiss(0);
    } catch (const std::exception&) {
        // The other ranks end because of the failure that ends this rank.
    }
}

void RankGroup::dismiss(int status)
{
    has_dismissed_ = true;
    // The other ranks serve until all of them have got the message.
    constexpr int most_attempts = 100;
    for (int attempt = 1;; ++attempt) {
        try {
            return comm_->run([&] {
                for (int rank = 1; rank < size(); ++rank)
                    comm_->give(rank, rank_message({.task = RankTask::Dismiss, .value = status}).take());
            });
        } catch (const ComputationError&) {
            if (attempt == most_attempts)
                throw;
        }
    }
}

int serve_flows(Transport& transport, int threads)
{
    Communicator comm(transport);
    const int n_here = count_on_this_machine(comm, transport);
    const int of_machine = threads > 0 ? threads : n_threads_of_arena();
    RankServer server(comm, std::max(1, of_machine / n_here));
    for (;;)
        if (const std::optional<int> status = server.serve())
            return *status;
}

}  // namespace seamflow
