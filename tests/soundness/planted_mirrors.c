/* The planted fault: a mirror with one end out of view is out of view. */
#include "ideal/look.h"
#include "planted.h"

bool __wrap_look_out_of_view(const struct look *look, const struct silhouette *silhouette);

void planted_begin(void)
{
}

bool __wrap_look_out_of_view(const struct look *look, const struct silhouette *silhouette)
{
    return vec2_cross(look->view_right, silhouette->right_m) < 0 ||
           vec2_cross(silhouette->left_m, look->view_left) < 0;
}
