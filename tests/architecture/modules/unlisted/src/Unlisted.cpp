#include "lamp/unlisted/Unlisted.h"
