# Builds a folder of stages: one that needs a library of its own or speaks a foreign format, or one of yours.
#
#     needs = expat                                  # names of pkg-config; none: leave the line out
#     stages = traffic_sumo traffic_commonroad       # each NAME.c defines const struct stage stage_NAME
#     PLUGIN ?= $(shell pkg-config --print-errors --variable=plugin glint || echo glint.pc)
#     include $(PLUGIN)
#
# is the folder's whole Makefile. All C files of the folder belong to its stages, and protoc-c makes NAME.pb-c.h and
# NAME.pb-c.c of NAME.proto. "made = NAME.c" names C files for which the Makefile has rules of its own, in $(out).
# Against an installed glint,
#
#     make -C FOLDER             makes a program of each stage: glint-traffic-sumo
#     make -C FOLDER install     puts them beside glint's
#
# In glint's own tree a folder stages/FOLDER is linked into glint by make. The Makefile there builds the archive
# alone, from its root, and gives PLUGIN, folder, out, CC, AR, CFLAGS and GLINT_CFLAGS.

MAKEFLAGS += -r
Q = $(if $(V),,@)
CFLAGS ?= -std=c11 -D_XOPEN_SOURCE=700 -O2 -g
GLINT_CFLAGS ?= $(shell pkg-config --cflags glint)
folder ?= .
out ?= $(folder)/build

plugin_flags := $(if $(needs),$(shell pkg-config --cflags $(needs))) -iquote $(out) -MMD -MP
plugin_interfaces := $(patsubst $(folder)/%.proto,$(out)/%.pb-c,$(wildcard $(folder)/*.proto))
plugin_objects := $(patsubst $(folder)/%.c,$(out)/%.c.o,$(wildcard $(folder)/*.c)) \
    $(plugin_interfaces:%=%.o) $(made:%.c=$(out)/%.o)
plugin_archive := $(out)/plugin.a
plugin_programs := $(foreach stage,$(stages),$(folder)/glint-$(subst _,-,$(stage)))

all: $(plugin_programs)

$(out)/%.c.o: $(folder)/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(GLINT_CFLAGS) $(CFLAGS) $(plugin_flags) -c -o $@ $<

# The C of protobuf-c has no room for a field called "base".
$(out)/%.proto: $(folder)/%.proto
	@mkdir -p $(@D)
	$(Q)sed 's/ base = / body = /' $< >$@

$(out)/%.pb-c.c: $(plugin_interfaces:%.pb-c=%.proto)
	$(Q)protoc-c --proto_path=$(out) --c_out=$(out) $(out)/$*.proto

# What a program writes is not held to warnings.
$(out)/%.o: $(out)/%.c
	$(Q)$(CC) $(GLINT_CFLAGS) $(CFLAGS) -w $(plugin_flags) -c -o $@ $<

$(plugin_objects): | $(plugin_interfaces:%=%.c)

$(plugin_archive): $(plugin_objects)
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $^

# The main of a program runs its one stage.
define plugin_main
#include "run/chain.h"

extern const struct stage STAGE;

int main(int count, char **words)
{
    return chain_main(&STAGE, count, words);
}
endef

$(out)/main.c: $(plugin_archive)
	$(file >$@,$(plugin_main))

$(plugin_programs): $(folder)/glint-%: $(out)/main.c $(plugin_archive)
	$(Q)$(CC) $(GLINT_CFLAGS) $(CFLAGS) -DSTAGE=stage_$(subst -,_,$*) $(LDFLAGS) -o $@ $^ \
	    $(if $(needs),$(shell pkg-config --libs $(needs))) $(shell pkg-config --libs glint)

install: all
	install -m 755 $(plugin_programs) $(DESTDIR)$(shell pkg-config --variable=bindir glint)

clean:
	rm -rf $(out) $(plugin_programs)

.PHONY: all install clean
.PRECIOUS: $(out)/%.proto $(out)/%.pb-c.c

-include $(wildcard $(out)/*.d)
