#include "engine/ranks/communicator_ranks.h"

#include <utility>

#include "engine/ranks/packing.h"

namespace seamflow {

CommunicatorRanks::CommunicatorRanks(Communicator& comm, std::vector<Index> holders, std::vector<Index> global_numbers)
    : InterfaceRanks(comm.rank(), std::move(holders), std::move(global_numbers))
    , comm_(&comm)
{
}

InterfaceRanks::Numbers CommunicatorRanks::gather(const std::vector<double>& own)
{
    Numbers all;
    for (const Bytes& bytes : comm_->allgather(packed(own)))
        all.push_back(unpacked<double>(bytes));
    return all;
}

InterfaceRanks::Numbers CommunicatorRanks::exchange(std::span<const Index> others, const Numbers& to_each)
{
    std::vector<Bytes> bytes;
    for (const std::vector<double>& numbers : to_each)
        bytes.push_back(packed(numbers));
    Numbers from_each;
    for (const Bytes& received : comm_->exchange(others, std::move(bytes)))
        from_each.push_back(unpacked<double>(received));
    return from_each;
}

}  // namespace seamflow
