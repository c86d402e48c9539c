/* The least and the most that a quantity can be, whatever is drawn: what is decided by these holds
 * for every draw. */
#ifndef BOUNDS_H
#define BOUNDS_H

struct bounds {
    double least, most;
};

#endif
