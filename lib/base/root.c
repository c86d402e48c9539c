#include "base/root.h"

struct root root_between(double low, double high, double width,
                         bool (*holds)(const void *of, double x), const void *of)
{
    while (high - low > width) {
        double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high)
            break;
        if (holds(of, middle))
            low = middle;
        else
            high = middle;
    }
    return (struct root){low, high};
}
