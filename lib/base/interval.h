/* The least and the most that a quantity can be, whatever is drawn: what is decided by these holds
 * for every draw. */
#ifndef INTERVAL_H
#define INTERVAL_H

struct interval {
    double least, most;
};

#endif
