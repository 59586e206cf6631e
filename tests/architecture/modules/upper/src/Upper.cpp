#include "lamp/lower/Lower.h"
#include "lamp/upper/Upper.h"
