/* No planted fault: the decisions of lib/ as they are. */
#include "planted.h"

void planted_begin(void)
{
}
