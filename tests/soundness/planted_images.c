/* The planted fault: a body's image is out of view if its centre is. */
#include "ideal/look.h"
#include "planted.h"

bool __real_look_disc_out_of_view(const struct look *look, double rise_m, struct vec2 centre,
                                  double radius_m);
bool __wrap_look_disc_out_of_view(const struct look *look, double rise_m, struct vec2 centre,
                                  double radius_m);

void planted_begin(void)
{
}

bool __wrap_look_disc_out_of_view(const struct look *look, double rise_m, struct vec2 centre,
                                  double radius_m)
{
    (void)radius_m;
    return __real_look_disc_out_of_view(look, rise_m, centre, 0);
}
