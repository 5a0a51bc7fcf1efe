#include "samples/common/flow_choices.h"

namespace seamflow {

const std::vector<std::pair<std::string, Laplacian>>& laplacian_choices()
{
    static const std::vector<std::pair<std::string, Laplacian>> choices{{"fujiwara", Laplacian::Fujiwara},
                                                                        {"alexa-wardetzky", Laplacian::AlexaWardetzky},
                                                                        {"ptackova-velho", Laplacian::PtackovaVelho}};
    return choices;
}

const std::vector<std::pair<std::string, Conditions>>& conditions_choices()
{
    static const std::vector<std::pair<std::string, Conditions>> choices{
        {"adapted-robin", Conditions::AdaptedRobin},
        {"adapted-ventcell", Conditions::AdaptedVentcell},
        {"robin", Conditions::Robin},
        {"ventcell", Conditions::Ventcell},
        {"schwarz", Conditions::Schwarz}};
    return choices;
}

}  // namespace seamflow
