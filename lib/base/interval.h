/* Bounds of a quantity that hold for all random draws. A decision that rests on these bounds holds
 * for every random draw. */
#ifndef INTERVAL_H
#define INTERVAL_H

struct interval {
    double least, most;
};

#endif
