#include "lamp/registration/InitialAligner.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(InitialAligner, Stage, lamp)
