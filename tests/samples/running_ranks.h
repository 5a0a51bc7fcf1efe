#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "tests/samples/workshop.h"

/// Runs of smooth-distributed on ranks of MPI.
namespace seamflow::test {

/// @returns the exit status. @param n ranks.
inline int on_ranks(const Workshop& w, int n, const std::string& arguments)
{
    return w.run("timeout 100 " MPIRUN " -n " + std::to_string(n) + " " SMOOTH_DISTRIBUTED " " + arguments);
}

/// What the program itself said on standard error, without its name: MPI says something, too.
inline std::vector<std::string> messages(const Workshop& w, const std::string& program)
{
    std::vector<std::string> found;
    std::ifstream file(w.directory / "said");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(program + ": "))
            found.push_back(line.substr(program.size() + 2));
    return found;
}

/// Runs three ranks, kills one as soon as a shell's condition holds, and waits for the others.
/// @param until may wait for a number of the process in `pid.1`, and for what is said in `out`; $! is mpirun.
/// @returns the exit status.
inline int on_ranks_of_which_one_is_killed(const Workshop& w, const std::string& arguments, const std::string& until)
{
    std::ofstream(w.directory / "rank.sh") << "echo $$ >pid.$OMPI_COMM_WORLD_RANK\n"
                                              "exec " SMOOTH_DISTRIBUTED " "
                                           << arguments << '\n';
    std::ofstream(w.directory / "kill.sh") << "timeout 100 " MPIRUN " -n 3 sh rank.sh >out 2>&1 &\n"
                                              "until "
                                           << until
                                           << "; do sleep 0.1; kill -0 $! || { echo ended before; exit 0; }; done\n"
                                              "kill -9 $(cat pid.1)\n"
                                              "wait $!\n";
    return w.run("sh kill.sh");
}

}  // namespace seamflow::test
