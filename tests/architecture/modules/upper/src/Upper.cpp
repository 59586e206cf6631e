#include "lamp/upper/Upper.h"
#include "lamp/lower/Lower.h"
