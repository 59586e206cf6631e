#include "lamp/registration/Verifier.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Verifier, Stage, lamp)
