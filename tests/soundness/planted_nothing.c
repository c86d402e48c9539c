/* The planner as it is. */
#include "planted.h"

void planted_begin(void)
{
}
