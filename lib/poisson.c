#include "poisson.h"

#include "elementary.h"
#include "random.h"

int poisson_draw(double mean, double uniform)
{
    double term = elementary_exp(-mean);
    double cumulative = term;
    int count = 0;
    while (cumulative < uniform) {
        count++;
        term *= mean / count;
        /* Rounding may keep the sum below the largest draws for ever. */
        if (count > mean && cumulative + term == cumulative)
            break;
        cumulative += term;
    }
    return count;
}

int poisson_most(double mean)
{
    return poisson_draw(mean, RANDOM_MOST);
}
