classdef sparse_local_plan < handle
%SPARSE_LOCAL_PLAN  Local solves, prepared: b is known in rows I, and x is wanted in rows J.
%
%   P = F.plan(I, J)    of a factor F (sparse_local); ':' stands for all rows
%   x = P.solve(b)      numel(J) x k for b of numel(I) x k; the same numbers as F \ b has there
%
%   A plan keeps its factor, and stays valid when that is refactored, updated or changed.
%
%   See also sparse_local.

    properties (SetAccess = private)
        factor; % the factor, a sparse_local
    end
    properties (SetAccess = private, Hidden = true, Transient = true)
        id = 0; % of the object in sparse_local_mex; 0: none
    end

    methods
        function this = sparse_local_plan(F, bset, xset)
            this.id = sparse_local_mex('plan', F.id, F.rows(bset), F.rows(xset));
            this.factor = F;
        end

        function delete(this)
            if this.id > 0, sparse_local_mex('free', this.id); end
            this.id = 0;
        end

        function x = solve(this, b)
            % x = P.solve(b): x in the rows of the plan.
            x = sparse_local_mex('plan_solve', this.factor.id, this.id, full(double(b)));
        end

        function disp(this)
            fprintf('  a plan of local solves over%s', evalc('disp(this.factor)'));
        end
    end
end
