/* Seconds of wall-clock time since some moment. */
#ifndef PROPELLER_CLOCK_H
#define PROPELLER_CLOCK_H

double clock_seconds(void);

#endif
