#include "solvers/laplacian/symmetric_laplacian.h"

#include "partition/errors.h"

namespace seamflow {

bool is_symmetric(Laplacian laplacian)
{
    return traits_of(laplacian).is_symmetric;
}

std::unique_ptr<SymmetricLaplacian> make_symmetric_laplacian(Laplacian laplacian, const FacesOnBothSides& faces)
{
    switch (laplacian) {
    case Laplacian::Fujiwara:
        return make_symmetric_fujiwara(faces);
    case Laplacian::AlexaWardetzky:
        return make_symmetric_alexa_wardetzky(faces);
    default:
        break;
    }
    throw OptionError("the Laplacian is not symmetric");
}

}  // namespace seamflow
