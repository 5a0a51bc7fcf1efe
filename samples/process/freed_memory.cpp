#include "samples/process/freed_memory.h"

#include <malloc.h>

namespace seamflow {

void return_freed_memory()
{
    malloc_trim(0);
}

}  // namespace seamflow
