/* Which way the electric field swings: along the road's surface or across it. */
#ifndef POLARIZATION_H
#define POLARIZATION_H

enum polarization { POLARIZATION_HORIZONTAL, POLARIZATION_VERTICAL };

#endif
