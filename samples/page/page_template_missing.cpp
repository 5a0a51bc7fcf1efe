// Replaces the page if the project is built without npm.

#include "samples/page/page_template.h"

namespace seamflow {

const std::string& page_template()
{
    static const std::string none;
    return none;
}

}  // namespace seamflow
