#pragma once

#include "lamp/upper/Upper.h"
